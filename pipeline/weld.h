// Numbers points by their bits: equal positions get equal ids.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace edgewise {

/// A hash table of points; ids count up in order of first appearance. -0 and +0 are the same coordinate.
class PointTable {
  public:
    explicit PointTable(std::size_t expected) : slots_(std::bit_ceil(expected * 2 + 16), kFree) {
        points_.reserve(expected);
    }

    std::uint32_t id(const glm::dvec3& point) {
        if (points_.size() * 2 >= slots_.size()) grow();
        const glm::dvec3 p = point + 0.0;
        std::size_t slot = home(p);
        for (; slots_[slot] != kFree; slot = (slot + 1) & (slots_.size() - 1))
            if (points_[slots_[slot]] == p) return slots_[slot];
        slots_[slot] = static_cast<std::uint32_t>(points_.size());
        points_.push_back(p);
        return slots_[slot];
    }

    const std::vector<glm::dvec3>& points() const { return points_; }

  private:
    static constexpr std::uint32_t kFree = 0xffffffffu;

    std::size_t home(const glm::dvec3& p) const {
        std::uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) {
            hash = (hash ^ std::bit_cast<std::uint64_t>(p[axis])) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 32;
        }
        return hash & (slots_.size() - 1);
    }

    void grow() {
        slots_.assign(slots_.size() * 2, kFree);
        for (std::uint32_t i = 0; i < points_.size(); ++i) {
            std::size_t slot = home(points_[i]);
            while (slots_[slot] != kFree) slot = (slot + 1) & (slots_.size() - 1);
            slots_[slot] = i;
        }
    }

    std::vector<glm::dvec3> points_;
    std::vector<std::uint32_t> slots_;
};

}  // namespace edgewise
