// What weights' shaders and pipeline/vulkan/weights.cpp agree on.

/// Places for a kernel's numbers: as many doubles as every device's uniform buffers hold.
const int kKernelNumbers = 2048;

/// A tile is as many pixels wide and high: a workgroup, a pixel an invocation.
const int kTilePx = 8;

struct GpuCarrierLine {
    double origin_x, origin_y, nx_hi, nx_lo, ny_hi, ny_lo, c_hi, c_lo, len, direction_x, direction_y;
};

struct GpuRowOwner {
    double x_px;
    uint owner, pad;
};

/// A segment in a tile's list, and its owners' places among the tile's owners.
struct GpuTileSegment {
    uint segment, left, right, tile;
};

/// A segment and a pixel that it may touch.
struct GpuPair {
    uint segment, left, right;  // as the entry's
    uint pixel, sums;           // tile of the box times 64, and the place in the tile; sums before the tile's
};

/// What a pixel has met beside its sums: how many segments touch it, and the last of a chain of notes.
struct GpuPixelState {
    uint touched, notes;  // notes: index + 1, or 0
};

/// A segment met the support's border, or the point where owners are looked up. [E12], [E13], [E15]
struct GpuBorderNote {
    double first, second;  // a crossing's order and doubt; a base point's distance2 and cosine
    uint next, kind;       // next as in GpuPixelState
    uint left, right;      // places of the segment's owners
};
const uint kNoteEntry = 0u;      // from the left owner into the right one, along the border
const uint kNoteExit = 1u;       // from the right one into the left one
const uint kNoteBaseLeft = 2u;   // the left owner holds the point
const uint kNoteBaseRight = 3u;
const uint kNotesPerPair = 3u;

/// What a pixel comes to.
const uint kPixelSums = 0u;    // the tile's owners where their sum is not 0
const uint kPixelWhole = 1u;   // one owner: it is named
const uint kPixelHanded = 2u;  // left to the host

/// What a tile of a box came to.
struct GpuTileReport {
    uint terms, whole;
};

struct WeightPush {
    double radius, inner_radius;
    double reach;               // of pairs
    double offset_x, offset_y;  // whole pixels
    int x0, y0, width, height;
    uint tiles, tile_columns;
    uint count;                // of the dispatch's entries, or pairs
    uint first, pairs_before;  // of the dispatch's entries: the first, and all pairs before the box's
    int row_begin;             // of the map's rows
    uint group_row;     // workgroups a row of them
    uint first_tile, list_columns;  // of the lists: the box's first, and how many lie in a row
};

/// Of the passes that make a box of tiles' lists.
struct WeightListPush {
    double offset_x, offset_y, reach;
    int x0, y0;
    uint columns, rows;  // of tiles
    uint segments, group_row;
};

const int kWeightNumbers = 0;  // uniform, kKernelNumbers of them
const int kWeightSegments = 1;   // GpuSegment
const int kWeightLines = 2;      // GpuCarrierLine
const int kWeightOffsets = 3;    // by tile of the lists, into the next, twice
const int kWeightEntries = 4;    // GpuTileSegment
const int kWeightSlots = 5;      // by tile of the lists, into the next
const int kWeightOwners = 6;     // ascending within a tile
const int kWeightSums = 7;       // int64, by owner of a tile and pixel of the tile
const int kWeightStates = 8;     // GpuPixelState, by tile and pixel of the tile
const int kWeightRowOffsets = 9;
const int kWeightRows = 10;      // GpuRowOwner
const int kWeightPixels = 11;    // by tile and pixel: kPixelSums ..., and the owner of a whole one
const int kWeightCounts = 12;    // entries by pixel of the box
const int kWeightOutOffsets = 13;
const int kWeightOutOwners = 14;
const int kWeightOutWeights = 15;
const int kWeightReports = 16;   // GpuTileReport, by tile of the box
const int kWeightHanded = 17;    // their number, then pixels of the box that are handed back
const int kWeightSumFirst = 18;  // by tile of the box: owners before it
const int kWeightPairFirst = 19; // by entry: pairs before it
const int kWeightPairs = 20;     // GpuPair
const int kWeightNotes = 21;     // GpuBorderNote, kNotesPerPair a pair
const int kWeightBindings = 22;

const int kListSegments = 0;   // GpuSegment, with owners by their classes' names
const int kListHistogram = 1;  // by tile: the owners on both sides of its segments
const int kListOffsets = 2;    // by tile, into sides; half of it into entries
const int kListEntries = 3;    // GpuTileSegment, at first with the owners themselves
const int kListSides = 4;      // owners, two a segment, then sorted; and as much room again
const int kListFirsts = 5;     // by side: 1 for the first of its name in the tile
const int kListPlaces = 6;     // by side: first ones before it
const int kListSlots = 7;      // by tile, into owners
const int kListOwners = 8;
const int kListPairCounts = 9;  // by entry: pixels of the tile that it may touch
const int kListBindings = 10;
