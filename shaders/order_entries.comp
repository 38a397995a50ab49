#version 460
// One invocation a pixel: its list, from where resolve.comp left it to where the pixels' order wants it.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
layout(local_size_x = 64) in;
#include "shared/layouts.glsl"
layout(std430, binding = kOrderFirst) readonly buffer First { uint first_entry[]; };
layout(std430, binding = kOrderOffsets) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = kOrderFromOwners) readonly buffer FromOwners { uint from_owner[]; };
layout(std430, binding = kOrderFromWeights) readonly buffer FromWeights { int64_t from_weight[]; };
layout(std430, binding = kOrderOwners) writeonly buffer Owners { uint entry_owner[]; };
layout(std430, binding = kOrderWeights) writeonly buffer Weights { int64_t entry_weight[]; };
layout(push_constant) uniform Push { OrderPush push; };

void main() {
    uint pixel = (gl_WorkGroupID.y * push.row) + gl_GlobalInvocationID.x;
    if (pixel >= push.pixels || first_entry[pixel] == kHandedBack) return;
    uint first = first_entry[pixel], to = offsets[pixel], count = offsets[pixel + 1u] - to;
    for (uint k = 0u; k < count; ++k)
        entry_owner[to + k] = from_owner[first + k], entry_weight[to + k] = from_weight[first + k];
}
