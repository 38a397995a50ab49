// Pieces from cells become maximal segments: what a cell's border cut is joined again, bit for bit.
#pragma once

#include <span>
#include <vector>

#include "analytic/cell.h"

namespace edgewise {

/// By line, then along it: an order that does not depend on how the pieces came.
bool pieceBefore(const SegmentPiece& p, const SegmentPiece& q);

/// One table of the stacks of several outputs, by whose names their pieces then go.
LayerStacks joinStacks(std::span<CellOutput* const> outputs);

/// Joins pieces of the same line and owners that share an end; `pieces` sorted by pieceBefore.
void mergeSorted(const ScreenScene& scene, std::span<const SegmentPiece> pieces, VisibleMap& map);

/// How many lines and segments sorted pieces become.
struct MergedCounts {
    std::size_t lines = 0, segments = 0;
};
MergedCounts countMerged(const ScreenScene& scene, std::span<const SegmentPiece> pieces);

/// mergeSorted() of some lines' pieces into their place in the map, behind `before`.
void mergeInto(const ScreenScene& scene, std::span<const SegmentPiece> pieces, const MergedCounts& before,
               std::span<CarrierLine> lines, std::span<VisibleSegment> segments);

/// Sorts a row by x and joins neighbours of one owner at its front; returns how many are left.
std::size_t joinRow(std::span<RowOwner> row);

/// Rows row_begin..row_end from row pieces in any order: neighbours of one owner are joined.
void mergeRows(std::span<const RowPiece> pieces, int row_begin, int row_end, VisibleMap& map);

}  // namespace edgewise
