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
    double a_grid[2], a_rest[2], b_grid[2], b_rest[2], len;
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
const int kGatherDirect = 2;     // of each narrow triangle: its first cell, and 4 bits: which of 2 x 2 it meets
const int kGatherWide = 3;       // triangles whose box is more than 2 x 2 cells
const int kGatherDraw = 4;       // the indirect command that rasterizes them
const int kGatherOffsets = 5;    // of each cell, into the ids
const int kGatherIds = 6;        // of triangles, by cell
const int kGatherBindings = 7;

/// Of scan: what one workgroup adds up, and one invocation of it.
const uint kScanItems = 16;
const uint kScanBlock = 128 * kScanItems;

/// The longest list that sort_lists sorts: n ceil(log2 n) loops.
const uint kSortLongest = 4096;

// ---- Shading: pipeline/vulkan/scene_upload.h fills these, shade.comp reads them.

// What a scene uses, as bits; what is not set is neither compiled in nor uploaded.
const uint kUsesTable = 1u;              // colours that cannot vary, made by the host
const uint kUsesShading = 2u;            // owners that the device shades
const uint kUsesVarying = 4u;            // some of them vary over the triangle: the closest point is wanted
const uint kUsesVertexColors = 8u;
const uint kUsesTextures = 16u;
const uint kUsesLight = 32u;             // lit materials
const uint kUsesVertexNormals = 64u;
const uint kUsesNormalMaps = 128u;
const uint kUsesPositionalLights = 256u;  // points and spots
const uint kUsesStacks = 512u;
const uint kUsesPoints = 1024u;          // --shading centroid, samples:N
const uint kUsesAlpha = 2048u;           // masks and blended materials

const uint kAbsent = 0xffffffffu;

const uint kFromTable = 1u;   // OwnerRecord::flags: first is a slot of the table
const uint kBackFacing = 2u;
const uint kConstantShade = 4u;  // shaded at its first corner

struct OwnerRecord {
    uint vertex0;
    uint vertex1;
    uint vertex2;
    uint surface;
    uint first;  // piece, or slot of the table
    uint pieces;
    uint plane;
    uint flags;
};

/// Of one geometry: where its vertices' doubles begin.
struct SurfaceRecord {
    uint material;
    uint positions;  // 3 a vertex, eye space
    uint normals;    // 3, unit, eye space; 0 where the file's is 0
    uint tangents;   // 4, world space
    uint uv0;        // 2
    uint uv1;
    uint colors;     // 4
    uint pad0;
};

struct MaterialRecord {
    double base_r;
    double base_g;
    double base_b;
    double base_a;
    double metallic;
    double roughness;
    double normal_scale;
    double occlusion_strength;
    double emissive_r;
    double emissive_g;
    double emissive_b;
    double alpha_cutoff;
    uint alpha_mode;  // kOpaqueMode ...
    uint unlit;
    uint first_map;
    uint maps;
};
const uint kOpaqueMode = 0u;
const uint kMaskMode = 1u;
const uint kBlendMode = 2u;

/// A texture as one slot of a material uses it.
struct MapRecord {
    double u_from_u;
    double v_from_u;
    double u_from_v;
    double v_from_v;
    double u_shift;
    double v_shift;
    uint role;  // kBaseMap ...
    uint uv;
    int wrap_s;
    int wrap_t;
    int mag;
    int min;
    int mip;
    int levels;
    uint first_level;
    uint pad0;
};
const uint kBaseMap = 0u;
const uint kMetallicRoughnessMap = 1u;
const uint kOcclusionMap = 2u;
const uint kEmissiveMap = 3u;
const uint kNormalMap = 4u;

struct LevelRecord {
    int width;
    int height;
    uint first_texel;
    uint pad0;
};

/// Texels lie in banks, 16 bytes each: no binding of a storage buffer needs more than 2^27 bytes.
const uint kBankBits = 23u;
const uint kMostBanks = 4u;

struct LightRecord {
    double position_x;
    double position_y;
    double position_z;
    double along_x;
    double along_y;
    double along_z;
    double strength_r;
    double strength_g;
    double strength_b;
    double range;
    double cos_outer;
    double scale;
    int type;
    uint pad0;
};

/// One a picture.
struct ShadeFrame {
    double scale_px;
    double whole_x;
    double whole_y;
    double fraction_x;
    double fraction_y;
    double offset_x;
    double offset_y;
    double background_r;
    double background_g;
    double background_b;
    double ambient;
    double eye_from_world[9];  // columns
    uint perspective;
    uint uniform_view;
    uint lights;
    uint pad0;
};

/// Of one dispatch.
struct ShadePush {
    int x0;
    int y0;
    uint width;
    uint pixels;
    uint entries;
    uint row;  // entries that one row of workgroups takes
};

const int kShadeFrameBinding = 0;
const int kShadeOffsetsBinding = 1;  // by pixel, and the end
const int kShadeOwnersBinding = 2;   // by entry
const int kShadeColorsBinding = 3;   // by entry: colour and alpha; what was handed back has alpha -1
const int kShadeStatusBinding = 4;   // how many were handed back
const int kOwnerRecordsBinding = 5;
const int kTableBinding = 6;
const int kSurfacesBinding = 7;
const int kMaterialsBinding = 8;
const int kTrianglesBinding = 9;     // GpuTriangle
const int kPositionsBinding = 10;
const int kAttributesBinding = 11;
const int kPlaneNormalsBinding = 12;
const int kLightsBinding = 13;
const int kMapsBinding = 14;
const int kLevelsBinding = 15;
const int kStackFirstBinding = 16;
const int kStackLayersBinding = 17;
const int kPointEndsBinding = 18;
const int kPointsBinding = 19;
const int kBank0Binding = 20;
const int kBank1Binding = 21;
const int kBank2Binding = 22;
const int kBank3Binding = 23;
const int kEntryPixelsBinding = 24;  // by entry; kAbsent: it has to be looked up
const int kShadeBindings = 25;

/// Of the pass that tells entries which pixel is theirs.
struct SignPush {
    uint pixels;
    uint row;   // pixels that one row of workgroups takes
    uint most;  // entries that a pixel signs
};
const int kSignOffsetsBinding = 0;
const int kSignPixelsBinding = 1;
const int kSignBindings = 2;

// ---- Blending: blend.frag.
struct BlendPush {
    double contrast;  // of an edge
    uint width;
    uint pad0;
};
const int kBlendOffsetsBinding = 0;
const int kBlendWeightsBinding = 1;
const int kBlendShadesBinding = 2;
const int kBlendRgbaBinding = 3;
const int kBlendEdgeBinding = 4;
const int kBlendBindings = 5;

// ---- Rasterized samples: raster.vert, collect*.comp, uniform_pixels.comp, resolve.comp.

/// Of one draw. A target's pixel is 1/scale of a pixel.
struct RasterPush {
    double x0_px;  // the target's corner
    double y0_px;
    double scale;
    double shift_x;  // of the scene on the viewport, in pixels of the target
    double shift_y;
    double width;  // of the viewport
    double height;
    double anchor_x;  // ScreenScene::anchor_px
    double anchor_y;
    double depth_scale;
    double depth_offset;
};
const int kRasterTriangles = 0;  // GpuTriangle
const int kRasterClipped = 1;    // GpuTriangle: what was cut at the guard band
const int kRasterPlanes = 2;     // DepthPlane: three doubles
const int kRasterPieces = 3;     // what is drawn, in owner order
const int kRasterBindings = 4;
const uint kClippedPiece = 0x80000000u;

struct CollectPush {
    uint width;  // of the target
    uint height;
    uint samples;  // of a pixel, in the rows
    uint slot;     // of these, which one a target of one sample holds
};

/// Pixels of a box, and the window of pixels whose samples they look at.
struct ResolvePush {
    uint width;
    uint height;
    uint window_width;
    uint window_height;
    uint margin;
    uint columns;  // of samples a pixel
    uint rows;
    uint room;  // for entries
    uint row;   // of mixed pixels: what one row of workgroups takes
};
struct ResolveStatus {
    uint entries;      // the room that lists have taken; each pixel has one entry beforehand
    uint mixed;        // pixels with several owners
    uint handed_back;  // of these
};
const uint kResolveGroup = 32u;  // invocations of a workgroup
const uint kMixedPixel = 0xfffffffeu;
const uint kHandedBack = 0xffffffffu;
const int kResolveSamples = 0;
const int kResolveUniform = 1;
const int kResolveWeights = 2;       // by step of the walk
const int kResolvePixelWeights = 3;  // of all samples of the pixel, by its first step
const int kResolveCounts = 4;
const int kResolveStatus = 5;
const int kResolveFirst = 6;
const int kResolveMixed = 7;
const int kResolveOwners = 8;
const int kResolveEntryWeights = 9;
const int kResolvePlaces = 10;  // WalkPlace
const int kResolveBindings = 11;

/// The walk over a window goes pixel by pixel, sample by sample; at a pixel's first sample it may step over all of it.
struct WalkPlace {
    uint x;  // samples from the window's corner
    uint y;
    uint pixel_x;  // pixels, or kInsidePixel
    uint pixel_y;
};
const uint kInsidePixel = 0xffffffffu;

struct OrderPush {
    uint pixels;
    uint row;  // pixels that one row of workgroups takes
};
const int kOrderFirst = 0;
const int kOrderOffsets = 1;
const int kOrderFromOwners = 2;
const int kOrderFromWeights = 3;
const int kOrderOwners = 4;
const int kOrderWeights = 5;
const int kOrderBindings = 6;
