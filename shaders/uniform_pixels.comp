#version 460
// The owner of all samples of a pixel, or that they have several.
layout(local_size_x = 8, local_size_y = 8) in;
#include "shared/layouts.glsl"
layout(std430, binding = 0) readonly buffer Samples { uint samples[]; };
layout(std430, binding = 1) writeonly buffer Uniform { uint uniform_owner[]; };
layout(push_constant) uniform Push { ResolvePush push; };

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (at.x >= push.window_width || at.y >= push.window_height) return;
    uint stride = push.window_width * push.columns, first = at.y * push.rows * stride + at.x * push.columns;
    uint owner = samples[first];
    for (uint b = 0; b < push.rows; ++b)
        for (uint a = 0; a < push.columns; ++a)
            if (samples[first + b * stride + a] != owner) owner = kMixedPixel;
    uniform_owner[at.y * push.window_width + at.x] = owner;
}
