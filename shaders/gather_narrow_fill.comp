#version 460
// Triangles of one cell go to its list; the histogram says how many places of a list are still free.
layout(local_size_x = 64) in;
#include "shared/gather_buffers.glsl"
layout(std430, binding = kGatherDirect) readonly buffer Direct { uint cell_of[]; };
layout(std430, binding = kGatherOffsets) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = kGatherIds) writeonly buffer Ids { uint ids[]; };

void main() {
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= grid.count) return;
    uint cell = cell_of[triangle];
    if (cell == kNoCell) return;
    uint left = atomicAdd(histogram[cell], 0xffffffffu);
    ids[offsets[cell] + left - 1] = triangle;
}
