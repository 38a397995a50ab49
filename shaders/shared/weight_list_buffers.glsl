// GLSL only: the buffers of the passes that list a tile's segments and owners.
layout(local_size_x = 64) in;
#include "shared/real_bits.glsl"
#include "shared/layouts.glsl"
#include "shared/weight_layouts.glsl"

layout(std430, binding = kListSegments) readonly buffer Segments { GpuSegment segments[]; };
layout(std430, binding = kListHistogram) buffer Histogram { uint histogram[]; };
layout(std430, binding = kListOffsets) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = kListEntries) buffer Entries { GpuTileSegment entries[]; };
layout(std430, binding = kListSides) buffer Sides { uint sides[]; };
layout(std430, binding = kListFirsts) writeonly buffer Firsts { uint firsts[]; };
layout(std430, binding = kListPlaces) readonly buffer Places { uint places[]; };
layout(std430, binding = kListSlots) writeonly buffer Slots { uint slots[]; };
layout(std430, binding = kListOwners) writeonly buffer Owners { uint owners[]; };
layout(std430, binding = kListPairCounts) writeonly buffer PairCounts { uint pair_counts[]; };
layout(push_constant) uniform Push { WeightListPush push; };

uint groupIndex() { return gl_WorkGroupID.y * push.group_row + gl_WorkGroupID.x; }
uint tileCount() { return push.columns * push.rows; }
