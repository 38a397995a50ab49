#version 460
// One invocation a pixel: it signs its entries, the first `most` of them.
layout(local_size_x = 64) in;
#include "shared/real_bits.glsl"
#include "shared/layouts.glsl"

layout(std430, binding = kSignOffsetsBinding) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = kSignPixelsBinding) writeonly buffer Pixels { uint entry_pixel[]; };
layout(push_constant) uniform Push { SignPush push; };

void main() {
    uint pixel = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * push.row;
    if (pixel >= push.pixels) return;
    uint begin = offsets[pixel], end = min(offsets[pixel + 1u], begin + push.most);
    for (uint e = begin; e < end; ++e) entry_pixel[e] = pixel;
}
