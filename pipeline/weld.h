// Numbers points by their bits: equal positions get equal ids.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "pipeline/huge_pages.h"

namespace edgewise {

/// Which of many points are equal: a hash table that all threads fill. -0 and +0 are the same coordinate.
class PointTable {
  public:
    /// Ids count up in order of first appearance.
    explicit PointTable(ZeroedVector<glm::dvec3> points);

    /// By place in the points that it was made of.
    const ZeroedVector<std::uint32_t>& ids() const { return ids_; }
    /// By id: the first place that has it.
    const ZeroedVector<std::uint32_t>& firstPlaces() const { return first_places_; }
    /// By id.
    const ZeroedVector<glm::dvec3>& points() const { return points_; }

    /// Of a further point, which may be a new one.
    std::uint32_t id(const glm::dvec3& point);

  private:
    void findFirsts(std::span<const glm::dvec3> all);
    std::uint32_t placed(std::span<const glm::dvec3> all, std::uint32_t place, std::size_t slot);
    std::size_t home(const glm::dvec3& p) const;
    void grow();

    ZeroedVector<glm::dvec3> points_;
    ZeroedVector<std::uint32_t> ids_, first_places_;
    ZeroedVector<std::uint32_t> slots_;  ///< ids, from 1; while the table is made, places; 0: free
};

}  // namespace edgewise
