#version 460
// One invocation a pixel: where one owner has all samples around it that the filter reaches, that is its list, entry
// number `pixel`; the others are put on the list of mixed pixels.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
layout(local_size_x = 8, local_size_y = 8) in;
#include "shared/layouts.glsl"
#define bits64 int64_t
#include "shared/resolve.glsl"
layout(std430, binding = kResolveSamples) readonly buffer Samples { uint samples[]; };
layout(std430, binding = kResolveUniform) readonly buffer Uniform { uint uniform_owner[]; };
layout(std430, binding = kResolveWeights) readonly buffer Weights { int64_t weights[]; };
layout(std430, binding = kResolvePixelWeights) readonly buffer PixelWeights { int64_t pixel_weights[]; };
layout(std430, binding = kResolveCounts) writeonly buffer Counts { uint counts[]; };
layout(std430, binding = kResolveStatus) buffer Status { ResolveStatus status; };
layout(std430, binding = kResolveFirst) writeonly buffer First { uint first_entry[]; };
layout(std430, binding = kResolveMixed) writeonly buffer Mixed { uint mixed_pixels[]; };
layout(std430, binding = kResolveOwners) writeonly buffer Owners { uint entry_owner[]; };
layout(std430, binding = kResolveEntryWeights) writeonly buffer EntryWeights { int64_t entry_weight[]; };
layout(push_constant) uniform Push { ResolvePush push; };

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= push.width || pixel.y >= push.height) return;
    uint side = 2u * push.margin + 1u, at = pixel.y * push.width + pixel.x;
    uint owner = uniform_owner[(pixel.y + push.margin) * push.window_width + pixel.x + push.margin];
    bool mixed = owner == kMixedPixel;
    for (uint j = 0u; j < side; ++j)
        for (uint i = 0u; i < side; ++i) {
            bool reached = pixel_weights[(j * side + i) * push.rows * push.columns] != kUnreached;
            uint other = uniform_owner[(pixel.y + j) * push.window_width + pixel.x + i];
            mixed = mixed || (reached && other != owner);
        }
    if (mixed) {
        mixed_pixels[atomicAdd(status.mixed, 1u)] = at;
    } else {
        counts[at] = 1u, first_entry[at] = at;
        entry_owner[at] = owner, entry_weight[at] = int64_t(1) << 60;
    }
}
