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

/// Bytes that a cell costs at once, triangles or not: its count, its offset, and the owners along its rows,
/// held a second time while they are collected from the threads.
inline constexpr std::size_t kBytesPerCell =
    2 * sizeof(std::uint32_t) + sizeof(std::size_t) + 2 * kCellPx * sizeof(RowPiece);

/// Throws FailureError where the lattice alone, before anything is known of its cells, needs more than
/// `bytes`: a support far wider than the film does that.
void requireLattice(const CellGrid& grid, std::size_t bytes);

/// Strips of `box`, whole cells high, each with at most `bytes` of buffers. `reach_px`: how far a support
/// looks beyond its strip. Throws FailureError where even one row of cells needs more.
std::vector<PixelBox> bandsFor(const PixelBox& box, const CellGrid& grid, const IdLists& lists,
                               double reach_px, glm::dvec2 offset_px, std::size_t bytes);

}  // namespace edgewise
