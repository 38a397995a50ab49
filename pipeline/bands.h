// Bands: the film cut into strips whose buffers fit the memory that --memory allows.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/cell_grid.h"
#include "pipeline/film.h"
#include "pipeline/scan.h"

namespace edgewise {

/// Bytes that a piece may cost at once: itself, and the segment and the line that it may become. Collecting
/// the pieces from the threads holds them twice, which is less.
inline constexpr std::size_t kBytesPerPiece =
    sizeof(SegmentPiece) + sizeof(VisibleSegment) + sizeof(CarrierLine);

/// Pieces that a (cell, triangle) pair makes at least where it is worth counting: every edge is shared by
/// two triangles.
inline constexpr double kLeastPiecesPerPair = 1.5;

/// What the first strip reckons with: twice what 200,000 long triangles that pierce each other make.
inline constexpr double kFirstPiecesPerPair = 8.0;

/// Bytes that a cell costs at once, triangles or not: its count, its offset, and the owners along its rows,
/// held a second time while they are collected from the threads.
inline constexpr std::size_t kBytesPerCell =
    2 * sizeof(std::uint32_t) + sizeof(std::size_t) + 2 * kCellPx * sizeof(RowPiece);

/// Throws FailureError where the lattice alone, before anything is known of its cells, needs more than
/// `bytes`: a support far wider than the film does that.
void requireLattice(const CellGrid& grid, std::size_t bytes);

/// Strips of a box, whole cells high, one after the other from the top. How many pieces its triangles fall
/// into is known only once a strip is made: each strip reckons with half as many again as the worst so far.
/// Strips never enter the pixels.
class Bands {
  public:
    /// `reach_px`: how far a support looks beyond its strip. Throws FailureError where even one row of cells
    /// needs more than `bytes` at kLeastPiecesPerPair.
    Bands(const PixelBox& box, const CellGrid& grid, const IdLists& lists, double reach_px,
          glm::dvec2 offset_px, std::size_t bytes);

    /// The next strip; none below the last. One row of cells where the reckoning leaves no more.
    std::optional<PixelBox> next();

    /// The last strip's pieces.
    void made(std::uint64_t pieces);

  private:
    int rowEnd(int y) const;
    std::size_t pairs(int y0, int y1) const;
    double bytesOf(int y0, int y1, double pieces_per_pair) const;

    PixelBox box_, last_;
    CellGrid grid_;
    std::vector<std::size_t> pairs_above_;  ///< by row of cells
    double reach_px_, y_offset_px_;
    double bytes_, bytes_per_piece_;
    double pieces_per_pair_ = kFirstPiecesPerPair;
};

}  // namespace edgewise
