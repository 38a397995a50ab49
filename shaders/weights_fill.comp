#version 460
// The entries of every pixel: its owners whose sum is not 0, ascending.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/weight_buffers.glsl"

void main() {
    if (!findPixel()) return;
    uvec2 pixel = pixels[stateIndex()];
    uint at = out_offsets[pixelIndex()];
    if (pixel.x == kPixelWhole) {
        out_owners[at] = pixel.y;
        out_weights[at] = 1l << 60;
    }
    if (pixel.x != kPixelSums) return;
    for (uint place = 0u; place < ownerCount(); ++place) {
        int64_t sum = sums[sumIndex(place)];
        if (sum == 0l) continue;
        out_owners[at] = ownerAt(place);
        out_weights[at++] = sum;
    }
}
