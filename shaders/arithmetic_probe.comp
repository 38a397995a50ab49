#version 460
// Shared arithmetic as the device computes it, for comparison with the host: three results a pair of inputs.
layout(local_size_x = 64) in;
#include "shared/real_bits.glsl"
#include "shared/double_double.glsl"
#include "shared/transcendental.glsl"
#include "shared/erf.glsl"
#include "shared/fan_terms.glsl"

layout(std430, binding = 0) readonly buffer Inputs { real x[]; };
layout(std430, binding = 1) writeonly buffer Results { real y[]; };
layout(push_constant) uniform Count { uint count; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    real a = x[2 * i], b = x[2 * i + 1];
    y[8 * i] = atan2Real(a, b);
    y[8 * i + 1] = expNegative(absolute(a));
    y[8 * i + 2] = phi1(absolute(a));
    y[8 * i + 3] = logReal(absolute(a) + EDGEWISE_REAL(1e-30));
    y[8 * i + 4] = erfReal(a);
    y[8 * i + 5] = coneMean(a, b, b + EDGEWISE_REAL(0.25), EDGEWISE_REAL(0.25), EDGEWISE_REAL(2.0));
    y[8 * i + 6] = twoProd(a, b).lo;
    y[8 * i + 7] = ddDiv(ddMul(twoSum(a, b), twoSum(b, a)), twoSum(a, EDGEWISE_REAL(1.0))).lo;
}
