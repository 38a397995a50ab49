// Pieces from cells become maximal segments: what a cell's border cut is joined again, bit for bit.
#pragma once

#include <span>

#include "analytic/cell.h"

namespace edgewise {

/// Joins pieces of the same line and owners that share an end. Sorts `pieces`.
/// Gives lines and segments in an order that does not depend on how the pieces came.
void mergeSegments(const ScreenScene& scene, std::vector<SegmentPiece>& pieces, VisibleMap& map);

/// Rows row_begin..row_end from row pieces in any order: neighbours of one owner are joined.
void mergeRows(std::span<const RowPiece> pieces, int row_begin, int row_end, VisibleMap& map);

}  // namespace edgewise
