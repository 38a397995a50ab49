#version 460
// Triangles of few cells go to their lists; the histogram says how many places of a list are still free.
layout(local_size_x = 64) in;
#include "shared/gather_buffers.glsl"
layout(std430, binding = kGatherDirect) readonly buffer Direct { uint direct[]; };
layout(std430, binding = kGatherOffsets) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = kGatherIds) writeonly buffer Ids { uint ids[]; };

void main() {
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= grid.count) return;
    uint found = direct[triangle];
    for (int i = 0; i < 4; ++i) {
        if ((found >> i & 1) == 0) continue;
        uint cell = directCell(found >> 4, i);
        uint left = atomicAdd(histogram[cell], 0xffffffffu);
        ids[offsets[cell] + left - 1] = triangle;
    }
}
