// Numbers points by their bits: equal positions get equal ids.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace edgewise {

/// Which of many points are equal: a hash table that all threads fill. -0 and +0 are the same coordinate.
class PointTable {
  public:
    /// Ids count up in order of first appearance.
    explicit PointTable(std::vector<glm::dvec3> points);

    /// By place in the points that it was made of.
    const std::vector<std::uint32_t>& ids() const { return ids_; }
    /// By id: the first place that has it.
    const std::vector<std::uint32_t>& firstPlaces() const { return first_places_; }
    /// By id.
    const std::vector<glm::dvec3>& points() const { return points_; }

    /// Of a further point, which may be a new one.
    std::uint32_t id(const glm::dvec3& point);

  private:
    static constexpr std::uint32_t kFree = 0xffffffffu;

    void findFirsts(const std::vector<glm::dvec3>& all);
    std::size_t home(const glm::dvec3& p) const;
    void grow();

    std::vector<glm::dvec3> points_;
    std::vector<std::uint32_t> ids_, first_places_;
    std::vector<std::uint32_t> slots_;  ///< ids; while the table is made, places
};

}  // namespace edgewise
