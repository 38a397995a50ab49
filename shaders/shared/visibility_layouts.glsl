// What the buffers of the visibility stage hold, and which binding holds what: one text for C++ and GLSL. Scalars
// only. Points are x, y on the grid and the rests of x, y.

/// A square cell and its candidates, kept[begin] .. kept[begin + count].
struct GpuCell {
    double min_x, min_y, size_px, origin_x, origin_y;
    uint source, begin, count, panes, state, untouched;  // source: where the candidates are read from
};

/// analytic/cell.h: SegmentPiece. `tag`: kNoTag, or the place in the list of leaves of the one that it is of; a
/// piece counts if that leaf was done. One with equal owners counts for nothing.
struct GpuPiece {
    double a[4], b[4];
    uint key_low, key_high, line_i, line_j, left, right, tag, pad;
};

/// analytic/cell.h: RowPiece. Those of one cell and row lie one behind the other.
struct GpuRowPiece {
    double x_px;
    int row;
    uint owner, tag, pad;
};

/// analytic/cell_clip.h: LeafLine, or LeafHorizontal with enter and exit as low and high.
struct GpuLine {
    double a[2], b[2], A[2], B[2], C[2];
    double y0[2], y1[2], in0[2], in1[2];  // OrderKeys; of a horizontal in0 is its key
    double enter[4], exit[4], slope, x_low, x_high;
    uint key_low, key_high, line_i, line_j, bounds, span;  // span: numbers of keys, see visibility_keys.comp
    int side_before, side_after;
};

/// analytic/slab_sweep.cpp: Track; what a dispatch leaves to the next, and abscissae at the slab's top and bottom.
struct GpuTrack {
    double x, grid[2], rest[2], start[4];
    uint noted, is_open, left, right;
};

/// Where two lines of a leaf meet.
struct GpuEvent {
    double key[2], point[4];
    uint p, q, slab, pad;  // slab: the number of its key
};

/// An OrderKey and its ordinate; of an item that is sorted, whose it is.
struct GpuKey {
    double key[2], y[2];
    uint of, pad;
};

/// A depth plane about the leaf's origin.
struct GpuLocalPlane {
    double a, b, c, error;
    uint plane, owner;
};

/// A row meets an edge of a sheet.
struct GpuCrossing {
    double x, slope;
    int row;
    uint before, after, pad;
};

/// A leaf while it is swept.
struct GpuLeaf {
    uint cell, state, run, triangles;
    uint lines, horizontals, events, keys;
    uint slab, order, entries, next_entry;
    uint next_event, next_horizontal, above_first, above_count;
    uint depth_lines, compared_exactly, closings, pad;
};

/// What is common to all shaders of the stage.
struct VisibilityPush {
    double anchor_x, anchor_y;
    int x0_px, y0_px, columns, flags;
    uint first, count, max_triangles, sheet_small;
    double min_cell_px;
    uint sheet_most, loop_turns;
};

/// Counters that the shaders share, and the room that the buffers have.
struct GpuVisibilityStatus {
    uint cells, kept, leaves, handed;          // grow
    uint pieces, rows, unfinished, undecided;  // grow
    uint cells_room, kept_room, pieces_room, rows_room;
    uint certified, slabs, depth_lines, exact_depth;
    uint hidden, closings, table, table_room;
    uint crossings, crossings_room, swept, overruns;
};

// VisibilityPush::flags
const int kDropHidden = 1;
const int kCertify = 2;
const int kEveryDepthLine = 4;
const int kSomeSeeThrough = 8;

// GpuCell::state
const uint kCellOpen = 0u;    // candidates collected, neither certified nor split
const uint kCellDone = 1u;    // certified, or empty
const uint kCellHanded = 2u;  // to the host's code
const uint kCellSplit = 3u;

// GpuLeaf::state
const uint kLeafRuns = 0u;
const uint kLeafDone = 1u;
const uint kLeafHanded = 2u;
const uint kLeafUndecided = 3u;  // a comparison of depths needs exact arithmetic

/// In GpuLine::span of a line that does not run inside.
const uint kPassesLeft = 256u;

const uint kNoTag = 0xffffffffu;

// Room for one leaf; what needs more is handed back.
const uint kLeafTriangles = 14u;
const uint kLeafLines = 48u;
const uint kLeafHorizontals = 24u;
const uint kLeafEvents = 200u;
const uint kLeafKeyItems = 400u;
const uint kLeafKeys = 256u;
const uint kLeafBreaks = 64u;
const uint kLeafOwners = 16u;  // its triangles' and the background, and one place to write beyond
/// Words of a leaf: order, lines by entry, profile above, pairs; items' order twice.
const uint kWordOrder = 0u;
const uint kWordEntry = 48u;
const uint kWordAbove = 96u;    // line, owner after it
const uint kWordItems = 352u;   // order of key items
const uint kWordItems2 = 752u;
const uint kWordPairs = 352u;   // candidate pairs, before keys are sorted
const uint kLeafWords = 1632u;
/// A sheet of more triangles is certified by the host; up to kSheetSmall, eight cells share a budget of loops.
const uint kSheetTriangles = 500u;
const uint kSheetSmall = 64u;
/// A cell with more candidates is the host's.
const uint kCellCandidates = 3000u;
/// Where the device is a program (DeviceTraits::loop_turns), loops of all invocations that run together, eight of them,
/// are stopped after so many turns, silently. Every shader counts its own, also those that others wait for: where one of
/// them has had its share, some may have been stopped.
const uint kTogether = 8u;

// Bindings.
const int kVisTriangles = 0;
const int kVisPlanes = 1;
const int kVisOffsets = 2;
const int kVisIds = 3;
const int kVisSeeThrough = 4;
const int kVisCells = 5;
const int kVisKept = 6;
const int kVisLeafCells = 7;
const int kVisStatus = 8;
const int kVisPieces = 9;
const int kVisRows = 10;
const int kVisHanded = 11;
const int kVisTable = 12;
const int kVisCrossings = 13;
const int kVisLeaves = 14;
const int kVisLines = 15;
const int kVisHorizontals = 16;
const int kVisTracks = 17;
const int kVisEvents = 18;
const int kVisKeys = 19;
const int kVisItems = 20;
const int kVisLocalPlanes = 21;
const int kVisWords = 22;
const int kVisBindings = 23;
