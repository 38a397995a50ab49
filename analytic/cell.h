// A cell of the screen and what visibility makes of it.
#pragma once

#include <cstdint>
#include <vector>

#include "analytic/carrier.h"

namespace edgewise {

/// Cell borders lie this far right of and below their grid position: no vertex, no axis-parallel edge and no
/// sample row ever lies on one.
inline constexpr double kBorderRestPx = 0x1p-34;

/// x0 < x <= x1, y0 < y <= y1 on the grid; the true borders are kBorderRestPx further.
struct Cell {
    glm::dvec2 min{0.0}, max{0.0};
};

/// A visible piece of a carrier inside one cell, directed like the carrier.
struct SegmentPiece {
    std::uint64_t key;
    LineRef line;
    Owner left, right;
    FinePoint a, b;
};

/// From x on along a sample row.
struct RowPiece {
    int row;
    Owner owner;
    double x_px;
};

/// How much work visibility did, and how often its exact parts fired.
struct VisibilityCounts {
    std::uint64_t pieces = 0;     ///< of segments, before those of neighbouring cells were joined
    std::uint64_t cells = 0;      ///< leaves that were swept
    std::uint64_t by_events = 0;  ///< of these, by their events alone: the rest slab by slab
    std::uint64_t certified = 0;  ///< cells that one sheet covers
    std::uint64_t slabs = 0;
    std::uint64_t depth_lines = 0;  ///< pairs of planes that change order inside a leaf
    std::uint64_t exact_depth = 0;  ///< depth comparisons that the filter left to exact arithmetic
    std::uint64_t hidden =
        0;  ///< (cell, triangle) pairs dropped behind a triangle or sheet that covers the cell
    std::uint64_t fine_orders = 0;  ///< orders of two lines that doubles left to their canonical points
    std::uint64_t closings = 0;     ///< pieces, longer than rounding, that close what planes left open

    void add(const VisibilityCounts& other);
};

struct VisibilityOptions {
    int max_triangles = 12;       ///< a cell with more is split
    double min_cell_px = 0.0625;  ///< but not below this
    bool occlusion = true;        ///< drop what one covering triangle hides
    bool sheets = true;           ///< ... and what one covering sheet of triangles hides
    bool certify = true;          ///< a cell that one sheet of triangles covers needs no sweep
    bool events = true;  ///< sweep by events where doubles are sure of every order, else slab by slab
    bool every_depth_line =
        false;  ///< of all pairs that meet in the cell, not only those that change order in it
    bool by_edges =
        false;  ///< EdgeVisibility in the place of sweeps: triangles are opaque, none pierces another
};

/// Everything visibility emits, appended cell by cell.
struct CellOutput {
    std::vector<SegmentPiece> segments;
    std::vector<RowPiece> rows;
    LayerStacks stacks;  ///< what owners of this output's pieces are stacks
    VisibilityCounts counts;
};

}  // namespace edgewise
