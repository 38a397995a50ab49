// GLSL only: the macros of shared_text.h and the powers of two, for real = double. C++ has analytic/real_lanes.h.
// EDGEWISE_REAL(x) is no macro here: whoever loads the text replaces it by xlf (README.md).
#define EDGEWISE_FN
#define EDGEWISE_EXACT_FN precise
#define EDGEWISE_PRECISE precise
#define EDGEWISE_INIT
#define EDGEWISE_END
#define mask bool
#define real double
#define splat(number) double(number)

/// floor(log2 x) of a normal x > 0.
double exponentOf(double x) { return double(int(unpackDouble2x32(x).y >> 20) - 1023); }

/// 2^k for an integer |k| <= 1022.
double exp2Int(double k) { return packDouble2x32(uvec2(0u, uint(int(k) + 1023) << 20)); }
