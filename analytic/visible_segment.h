// The visible map: segments between two owners, and the owners along the sample rows.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "analytic/layer_stacks.h"

namespace edgewise {

/// A point finer than double at x = 1000: grid + rest, |rest| <= kGridPx / 2, the sum is the point.
/// Adding whole pixels changes `grid` exactly and `rest` not at all.
struct FinePoint {
    glm::dvec2 grid{0.0};
    glm::dvec2 rest{0.0};
};

/// The line that carries a segment. With (dx, dy) = sample - origin,
///     cross(a - sample, b - sample) / |b - a| = h = (nx dx + ny dy + c) / length,
/// where n = (nx, ny) is held to about 106 bits (hi + lo). For an edge a -> b of the scene origin = a,
/// n = (-(b.y - a.y), b.x - a.x) exactly, c = 0.
struct CarrierLine {
    glm::dvec2 origin{0.0};  ///< on the grid
    double nx_hi = 0.0, nx_lo = 0.0;
    double ny_hi = 0.0, ny_lo = 0.0;
    double c_hi = 0.0, c_lo = 0.0;
    double length = 1.0;  ///< |n|
    glm::dvec2 direction{
        1.0, 0.0};  ///< unit; (ny, -nx) / length: the canonical direction, towards +y, or -x if horizontal
};

/// A maximal visible piece of a line between two owners. Directed a -> b along its line's direction:
/// `left` is the owner at smaller x (horizontal: at smaller y), and receives +F(a, b); `right` receives -F(a,
/// b).
struct VisibleSegment {
    FinePoint a, b;
    double length = 0.0;  ///< |b - a| px, rounded once
    std::uint32_t line = 0;
    Owner left = kBackground, right = kBackground;
};

/// The owner just right of x, from x to the next entry of the same row.
struct RowOwner {
    double x_px;
    Owner owner;
};

/// The front-most owners of a window of the screen: triangles, or stacks of see-through layers.
struct VisibleMap {
    std::vector<CarrierLine> lines;
    std::vector<VisibleSegment> segments;  ///< sorted by (line, position): independent of threads and tiles
    /// Owners along y = row_begin + k + 0.5: rows[row_offset[k]] .. rows[row_offset[k + 1]], by ascending x;
    /// the first entry reaches to the window's left border.
    int row_begin = 0;
    std::vector<std::size_t> row_offset;
    std::vector<RowOwner> rows;
    LayerStacks stacks;  ///< the owners that are several layers; sorted, whatever the threads and tiles
};

}  // namespace edgewise
