// Bands: the film cut into strips whose buffers fit the memory that --memory allows.
#pragma once

#include <vector>

#include "pipeline/cell_grid.h"
#include "pipeline/film.h"
#include "pipeline/scan.h"

namespace edgewise {

/// Bytes that a (cell, triangle) pair may cost at once: with every edge shared by two triangles, 1.5 pieces,
/// of which each may become a segment with a line of its own.
inline constexpr std::size_t kBytesPerPair =
    (3 * (sizeof(SegmentPiece) + sizeof(VisibleSegment) + sizeof(CarrierLine)) + 1) / 2 +
    sizeof(std::uint32_t);

/// Strips of `box`, whole cells high, each with at most `bytes` of buffers. `reach_px`: how far a support
/// looks beyond its strip. Throws FailureError where even one row of cells needs more.
std::vector<PixelBox> bandsFor(const PixelBox& box, const CellGrid& grid, const IdLists& lists,
                               double reach_px, glm::dvec2 offset_px, std::size_t bytes);

}  // namespace edgewise
