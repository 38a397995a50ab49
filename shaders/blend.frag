#version 460
// A fragment a pixel sums weights times colours of its entries, in the owners' order (NSAA section 3.3).
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/real_bits.glsl"
#include "shared/double_double.glsl"
#include "shared/transcendental.glsl"
#include "shared/layouts.glsl"
#define bits64 int64_t
#include "shared/blend.glsl"

layout(constant_id = 0) const uint kMostEntries = 0u;  // pixels with more are the host's

layout(std430, binding = kBlendOffsetsBinding) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = kBlendWeightsBinding) readonly buffer Weights { int64_t weights[]; };
layout(std430, binding = kBlendShadesBinding) readonly buffer Shades { double shades[]; };
layout(std430, binding = kBlendRgbaBinding) writeonly buffer Rgba { double rgba[]; };
layout(std430, binding = kBlendEdgeBinding) writeonly buffer Edge { float edge[]; };
layout(push_constant) uniform Push { BlendPush push; };

void main() {
    uint pixel = uint(gl_FragCoord.y) * push.width + uint(gl_FragCoord.x);
    uint first = offsets[pixel], end = offsets[pixel + 1u];
    if (end - first > kMostEntries) return;
    double infinity = packDouble2x32(uvec2(0u, 0x7ff00000u));
    PixelSum sum = PixelSum(dvec3(0.0), int64_t(0), 0.0, dvec3(infinity), dvec3(-infinity));
    for (uint e = first; e < end; ++e)
        sum = withOwner(sum, weights[e], dvec3(shades[4u * e], shades[4u * e + 1u], shades[4u * e + 2u]),
                        shades[4u * e + 3u]);
    rgba[4u * pixel] = sum.color.r;
    rgba[4u * pixel + 1u] = sum.color.g;
    rgba[4u * pixel + 2u] = sum.color.b;
    rgba[4u * pixel + 3u] = alphaOf(sum);
    edge[pixel] = contrastOf(sum) > push.contrast ? 1.0 : 0.0;
}
