// What buffers hold, and which binding holds what: one text for C++ and GLSL. Scalars only, so that std430 and
// C++ lay them out alike.

/// analytic/screen_triangle.h: ScreenTriangle, byte for byte.
struct GpuTriangle {
    double p_px[6];  // x, y of its three corners
    uint vertex[3];
    uint owner;
    uint plane;
};

/// A visible piece of a line between two owners, directed a -> b: analytic/visible_segment.h.
struct GpuSegment {
    double a_grid[2], a_rest[2], b_grid[2], b_rest[2], length;
    uint line, left, right, pad;
};

/// Push constants of gather: the lattice of cells, whole pixels.
struct GatherGrid {
    int x0_px, y0_px, columns, rows;
    uint count;  // of triangles
};

/// Of gather's shaders.
const int kGatherTriangles = 0;  // GpuTriangle
const int kGatherHistogram = 1;  // of each cell: triangles counted, or still to be filled in
const int kGatherDirect = 2;     // of each triangle: the only cell that it may meet, or kNoCell
const int kGatherWide = 3;       // triangles that may meet several cells
const int kGatherDraw = 4;       // the indirect command that rasterizes them
const int kGatherOffsets = 5;    // of each cell, into the ids
const int kGatherIds = 6;        // of triangles, by cell
const int kGatherBindings = 7;
const uint kNoCell = 0xffffffffu;

/// Of scan: what one workgroup adds up, and one invocation of it.
const uint kScanItems = 16;
const uint kScanBlock = 128 * kScanItems;

/// The longest list that sort_lists sorts: n ceil(log2 n) loops.
const uint kSortLongest = 4096;
