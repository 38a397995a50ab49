// GLSL only: the buffers of weights, and which pixel an invocation is.
layout(local_size_x = 64) in;
#include "shared/real_bits.glsl"
#include "shared/double_double.glsl"
#include "shared/transcendental.glsl"
#include "shared/layouts.glsl"
#include "shared/weight_layouts.glsl"

#ifdef EDGEWISE_READS_KERNEL
// in vectors of 16 bytes: so std140 packs them tightly
#ifdef EDGEWISE_FP32
layout(std140, binding = kWeightNumbers) uniform Numbers { vec4 kernel_vectors[kKernelNumbers / 4]; };
work kernelNumber(int i) { return kernel_vectors[i >> 2][i & 3]; }
#else
layout(std140, binding = kWeightNumbers) uniform Numbers { dvec2 kernel_vectors[kKernelNumbers / 2]; };
work kernelNumber(int i) { return kernel_vectors[i >> 1][i & 1]; }
#endif
#endif
layout(std430, binding = kWeightSegments) readonly buffer Segments { GpuSegment segments[]; };
layout(std430, binding = kWeightLines) readonly buffer Lines { GpuCarrierLine lines[]; };
layout(std430, binding = kWeightOffsets) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = kWeightEntries) readonly buffer Entries { GpuTileSegment entries[]; };
layout(std430, binding = kWeightSlots) readonly buffer Slots { uint slots[]; };
layout(std430, binding = kWeightOwners) readonly buffer Owners { uint owners[]; };
layout(std430, binding = kWeightSums) buffer Sums { int64_t sums[]; };
layout(std430, binding = kWeightStates) buffer States { GpuPixelState states[]; };
layout(std430, binding = kWeightRowOffsets) readonly buffer RowOffsets { uint row_offsets[]; };
layout(std430, binding = kWeightRows) readonly buffer Rows { GpuRowOwner rows[]; };
layout(std430, binding = kWeightPixels) buffer Pixels { uvec2 pixels[]; };
layout(std430, binding = kWeightCounts) buffer Counts { uint counts[]; };
layout(std430, binding = kWeightOutOffsets) readonly buffer OutOffsets { uint out_offsets[]; };
layout(std430, binding = kWeightOutOwners) writeonly buffer OutOwners { uint out_owners[]; };
layout(std430, binding = kWeightOutWeights) writeonly buffer OutWeights { int64_t out_weights[]; };
layout(std430, binding = kWeightReports) buffer Reports { GpuTileReport reports[]; };
layout(std430, binding = kWeightHanded) buffer Handed { uint handed[]; };
layout(std430, binding = kWeightSumFirst) readonly buffer SumFirst { uint sum_first[]; };
layout(std430, binding = kWeightPairFirst) readonly buffer PairFirst { uint pair_first[]; };
layout(std430, binding = kWeightPairs) buffer Pairs { GpuPair pairs[]; };
layout(std430, binding = kWeightNotes) buffer Notes { GpuBorderNote notes[]; };
layout(push_constant) uniform Push { WeightPush push; };

/// Of the dispatch's entries, or pairs.
uint flatIndex() { return (gl_WorkGroupID.y * push.group_row + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex; }

/// Which pixel this invocation sees: the tile of the box, and the place in the tile.
uint tile_index = 0u, place_in_tile = 0u;
uint stateIndex() { return tile_index * 64u + place_in_tile; }

/// The tile's place in the lists, its owners there, and how many sums of the box lie before its own.
uint listed_tile = 0u, owners_begin = 0u, owners_end = 0u, sums_begin = 0u;
void findTile() {
    uint row = tile_index / push.tile_columns, column = tile_index % push.tile_columns;
    listed_tile = push.first_tile + row * push.list_columns + column;
    owners_begin = slots[listed_tile];
    owners_end = slots[listed_tile + 1u];
    sums_begin = sum_first[tile_index];
}

/// In the box.
ivec2 pixelInBox() {
    int tile = int(tile_index), lane = int(place_in_tile), columns = int(push.tile_columns);
    return ivec2(tile % columns, tile / columns) * kTilePx + ivec2(lane % kTilePx, lane / kTilePx);
}
/// One workgroup a tile, one invocation a pixel.
bool findPixel() {
    tile_index = gl_WorkGroupID.y * push.group_row + gl_WorkGroupID.x;
    place_in_tile = gl_LocalInvocationIndex;
    if (tile_index >= push.tiles) return false;
    findTile();
    ivec2 at = pixelInBox();
    return at.x < push.width && at.y < push.height;
}
uint pixelIndex() { return uint(pixelInBox().y * push.width + pixelInBox().x); }
double sampleX() { return (double(push.x0 + pixelInBox().x) + 0.5lf) + push.offset_x; }
double sampleY() { return (double(push.y0 + pixelInBox().y) + 0.5lf) + push.offset_y; }

/// The sum of the tile's owner at `place` for this invocation's pixel.
uint sumIndex(uint place) { return (sums_begin + place) * 64u + place_in_tile; }
uint ownerCount() { return owners_end - owners_begin; }
uint ownerAt(uint place) { return owners[owners_begin + place]; }

/// splitmix64's mixer: sums of it tell whether two multisets of owners are equal.
uint64_t hashOf(uint owner) {
    uint64_t z = (uint64_t(owner) + 1ul) * packUint2x32(uvec2(0x7f4a7c15u, 0x9e3779b9u));
    z = (z ^ (z >> 30)) * packUint2x32(uvec2(0x1ce4e5b9u, 0xbf58476du));
    z = (z ^ (z >> 27)) * packUint2x32(uvec2(0x133111ebu, 0x94d049bbu));
    return z ^ (z >> 31);
}
