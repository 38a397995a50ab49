#version 460
// All samples of a pixel of a multisampled target, into the rows of all samples.
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
#include "shared/layouts.glsl"
layout(std430, binding = 0) writeonly buffer Owners { uint owners[]; };
layout(binding = 1) uniform texture2DMS target;
layout(push_constant) uniform Push { CollectPush push; };

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (at.x >= push.width || at.y >= push.height) return;
    for (uint s = 0; s < push.samples; ++s)
        owners[(at.y * push.width + at.x) * push.samples + s] = packUnorm4x8(texelFetch(target, ivec2(at), int(s)));
}
