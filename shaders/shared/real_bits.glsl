// GLSL only: the macros of shared_text.h and the powers of two, for real = double and work = double, or float with
// EDGEWISE_FP32. C++ has analytic/real_lanes.h. EDGEWISE_REAL(x) and EDGEWISE_WORK(x) are no macros here: whoever loads the
// text replaces them by literals (README.md).
#define EDGEWISE_FN
#define EDGEWISE_EXACT_FN precise
#define EDGEWISE_PRECISE precise
#define EDGEWISE_UNROLL [[unroll]]
#define EDGEWISE_INIT
#define EDGEWISE_END
#define EDGEWISE_IN(type) type
#define EDGEWISE_INOUT(type) inout type
#define EDGEWISE_BOTH(a, b) ((a) && (b))
#define EDGEWISE_EITHER(a, b) ((a) || (b))
#define mask bool
#define real double
#define splat(number) double(number)
#ifdef EDGEWISE_FP32
#define work float
#else
#define work double
#endif
#define work_mask bool
#define work_number work
#define splatWork(number) work(number)
#define numberOf(number) work(number)
bool anyLane(bool lane) { return lane; }

/// floor(log2 x) of a normal x > 0.
double exponentOf(double x) { return double(int(unpackDouble2x32(x).y >> 20) - 1023); }

/// 2^k for an integer |k| <= 1022.
double exp2Int(double k) { return packDouble2x32(uvec2(0u, uint(int(k) + 1023) << 20)); }

#ifdef EDGEWISE_FP32
float toWork(double x) { return float(x); }
double toReal(float x) { return double(x); }
float exponentOf(float x) { return float(int(floatBitsToUint(x) >> 23) - 127); }
float exp2Int(float k) { return uintBitsToFloat(uint(int(k) + 127) << 23); }
#endif
