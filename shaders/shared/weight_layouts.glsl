// What weights' shaders and pipeline/vulkan/weights.cpp agree on.

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
    uint segment, left, right;
};

/// What a pixel has met of its segments, beside its sums. [E12], [E13]
struct GpuPixelState {
    double base_distance2, base_cosine;
    double first_low, first_high;  // the crossing that comes first on the border: its order -+ doubt
    double next_low;               // where the next one may begin
    double last_high, last_low, before_high;
    uint base_owner, first_owner, last_owner;  // places: before the first crossing, after the last
    uint balance_low, balance_high;  // owners left less owners entered, hashed
    uint touched, crossings, pad;
};

/// What a pixel comes to.
const uint kPixelSums = 0u;    // the tile's owners where their sum is not 0
const uint kPixelWhole = 1u;   // one owner: it is named
const uint kPixelHanded = 2u;  // left to the host

/// What a box came to.
struct GpuWeightStatus {
    uint terms, whole, handed, pad;
};

struct WeightPush {
    double radius, inner_radius;
    double offset_x, offset_y;  // whole pixels
    int x0, y0, width, height;
    uint tiles, tile_columns;
    uint first, count;  // which entries of every list
    int row_begin;      // of the map's rows
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

const int kWeightNumbers = 0;
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
const int kWeightStatus = 16;    // GpuWeightStatus
const int kWeightHanded = 17;    // pixels of the box that are handed back
const int kWeightSumFirst = 18;  // by tile of the box: owners before it
const int kWeightBindings = 19;

const int kListSegments = 0;   // GpuSegment, with owners by their classes' names
const int kListHistogram = 1;  // by tile: the owners on both sides of its segments
const int kListOffsets = 2;    // by tile, into sides; half of it into entries
const int kListEntries = 3;    // GpuTileSegment, at first with the owners themselves
const int kListSides = 4;      // owners, two a segment, then sorted; and as much room again
const int kListFirsts = 5;     // by side: 1 for the first of its name in the tile
const int kListPlaces = 6;     // by side: first ones before it
const int kListSlots = 7;      // by tile, into owners
const int kListOwners = 8;
const int kListBindings = 9;
