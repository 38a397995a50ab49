// GLSL only: the macros of shared_text.h and the powers of two, for real = double or float. C++ has
// analytic/real_lanes.h. EDGEWISE_REAL(x) is no macro here: whoever loads the text replaces it (README.md).
#define EDGEWISE_FN
#define EDGEWISE_EXACT_FN precise
#define EDGEWISE_PRECISE precise
#define EDGEWISE_INIT
#define EDGEWISE_END
#define mask bool

#ifdef EDGEWISE_FP32
#define real float
/// floor(log2 x) of a normal x > 0.
float exponentOf(float x) { return float(int(floatBitsToUint(x) >> 23) - 127); }
/// 2^k for an integer |k| <= 126.
float exp2Int(float k) { return uintBitsToFloat(uint(int(k) + 127) << 23); }
#else
#define real double
double exponentOf(double x) { return double(int(unpackDouble2x32(x).y >> 20) - 1023); }
/// 2^k for an integer |k| <= 1022.
double exp2Int(double k) { return packDouble2x32(uvec2(0u, uint(int(k) + 1023) << 20)); }
#endif
#define splat(number) real(number)
