// The edges that the triangles of a cell share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "analytic/carrier.h"
#include "analytic/cell.h"
#include "analytic/screen_triangle.h"

namespace edgewise {

/// An edge of triangles of a list, which it names by their places there.
struct SharedEdge {
    static constexpr std::uint32_t kUnused = 0xffffffffu;
    std::uint64_t ends;                               ///< the vertex ids, the smaller one first
    LineRef canonical;                                ///< runs along the carrier's direction
    std::uint32_t with = kUnused, against = kUnused;  ///< the triangle whose boundary runs so, and the other
};

class SharedEdges {
  public:
    /// The edges of the listed triangles that may meet the cell.
    void collect(const ScreenScene& scene, const Cell& cell, std::span<const std::uint32_t> triangles);

    std::span<const SharedEdge> edges() const { return edges_; }
    /// Places of triangles that came to an edge whose side another one had: by place, 1 or 0.
    std::span<const std::uint8_t> surplus() const { return surplus_; }
    /// Whether each edge is used by exactly two triangles, in opposite directions.
    bool allPaired() const;

  private:
    void enter(const ScreenScene& scene, std::uint32_t triangle, std::uint32_t k, std::uint32_t place);

    std::vector<SharedEdge> edges_;
    std::vector<std::uint32_t> slots_;  ///< open addressing by `ends`: places in edges_, from 1
    std::vector<std::uint8_t> surplus_;
    bool any_surplus_ = false;
};

/// Whether p surely lies inside t (1), outside (-1), or rounding leaves it open (0).
int sideOfTriangle(const ScreenTriangle& t, glm::dvec2 p);

/// Two points of a cell on which no vertex or edge need lie: where one does, the other may serve.
std::array<glm::dvec2, 2> genericPoints(const Cell& cell);

}  // namespace edgewise
