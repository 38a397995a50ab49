// What the shared text needs of a `real`: one double, or 2, 4, 8 samples at once; and of `work`, the same or
// as many floats with EDGEWISE_FP32. Included inside a namespace, so that functions compiled for one
// instruction set are never linked into another: define EDGEWISE_LANES first, and include <immintrin.h>
// outside where EDGEWISE_X86 is defined. No include guard: each instruction set has its own copy.

#if EDGEWISE_LANES == 1
using real = double;
using mask = bool;
using bits = long;
EDGEWISE_FN unsigned laneSet(mask m) {
    return m ? 1u : 0u;
}
EDGEWISE_FN real sqrt(real x) {
    return __builtin_sqrt(x);
}
EDGEWISE_FN real laneNumbers() {
    return 0.0;
}
EDGEWISE_FN bits truncated(real x) {
    return static_cast<bits>(x);
}
#else
typedef double real __attribute__((vector_size(8 * EDGEWISE_LANES)));
typedef long bits __attribute__((vector_size(8 * EDGEWISE_LANES)));
using mask = decltype(real{} < real{});
#if defined(EDGEWISE_X86) && EDGEWISE_LANES == 8
EDGEWISE_FN unsigned laneSet(mask m) {
    return _mm512_movepi64_mask((__m512i)m);
}
EDGEWISE_FN real sqrt(real x) {
    return _mm512_maskz_sqrt_pd(0xff, x);
}
#elif defined(EDGEWISE_X86) && EDGEWISE_LANES == 4
EDGEWISE_FN unsigned laneSet(mask m) {
    return static_cast<unsigned>(_mm256_movemask_pd((__m256d)m));
}
EDGEWISE_FN real sqrt(real x) {
    return _mm256_sqrt_pd(x);
}
#elif defined(EDGEWISE_X86) && EDGEWISE_LANES == 2
EDGEWISE_FN unsigned laneSet(mask m) {
    return static_cast<unsigned>(_mm_movemask_pd((__m128d)m));
}
EDGEWISE_FN real sqrt(real x) {
    return _mm_sqrt_pd(x);
}
#else
EDGEWISE_FN unsigned laneSet(mask m) {
    unsigned set = 0;
    for (int i = 0; i < EDGEWISE_LANES; ++i) set |= (m[i] ? 1u : 0u) << i;
    return set;
}
EDGEWISE_FN real sqrt(real x) {
    real root;
    for (int i = 0; i < EDGEWISE_LANES; ++i) root[i] = __builtin_sqrt(x[i]);
    return root;
}
#endif
EDGEWISE_FN real laneNumbers() {
    real numbers;
    for (int i = 0; i < EDGEWISE_LANES; ++i) numbers[i] = i;
    return numbers;
}
EDGEWISE_FN bits truncated(real x) {
    return __builtin_convertvector(x, bits);
}
#endif

EDGEWISE_FN bool anyLane(mask m) {
    return laneSet(m) != 0;
}
EDGEWISE_FN real splat(double number) {
    return real{} + number;
}

/// floor(log2 x) of a normal x > 0. The exponent field, read as the low bits of 2^52 + field.
EDGEWISE_FN real exponentOf(real x) {
    bits field = (__builtin_bit_cast(bits, x) >> 52) | 0x4330000000000000;
    return __builtin_bit_cast(real, field) - (0x1p52 + 1023.0);
}

/// 2^k for an integer |k| <= 1022.
EDGEWISE_FN real exp2Int(real k) {
    return __builtin_bit_cast(real, __builtin_bit_cast(bits, k + (0x1p52 + 1023.0)) << 52);
}

#if !defined(EDGEWISE_FP32)
using work = real;
using work_mask = mask;
using work_number = double;
#elif EDGEWISE_LANES == 1
using work = float;
using work_mask = bool;
using work_number = float;
using work_bits = int;
EDGEWISE_FN work sqrt(work x) {
    return __builtin_sqrtf(x);
}
EDGEWISE_FN work toWork(real x) {
    return static_cast<work>(x);
}
EDGEWISE_FN real toReal(work x) {
    return x;
}
EDGEWISE_FN work fromBits(work_bits x) {
    return static_cast<work>(x);
}
EDGEWISE_FN work_bits toBits(work x) {
    return static_cast<work_bits>(x);
}
#else
typedef float work __attribute__((vector_size(4 * EDGEWISE_LANES)));
typedef int work_bits __attribute__((vector_size(4 * EDGEWISE_LANES)));
using work_mask = decltype(work{} < work{});
using work_number = float;
EDGEWISE_FN bool anyLane(work_mask m) {
    return anyLane(__builtin_convertvector(m, mask));
}
#if defined(EDGEWISE_X86) && EDGEWISE_LANES == 8
EDGEWISE_FN work sqrt(work x) {
    return _mm256_sqrt_ps(x);
}
#elif defined(EDGEWISE_X86) && EDGEWISE_LANES == 4
EDGEWISE_FN work sqrt(work x) {
    return _mm_sqrt_ps(x);
}
#else
EDGEWISE_FN work sqrt(work x) {
    work root;
    for (int i = 0; i < EDGEWISE_LANES; ++i) root[i] = __builtin_sqrtf(x[i]);
    return root;
}
#endif
EDGEWISE_FN work toWork(real x) {
    return __builtin_convertvector(x, work);
}
EDGEWISE_FN real toReal(work x) {
    return __builtin_convertvector(x, real);
}
EDGEWISE_FN work fromBits(work_bits x) {
    return __builtin_convertvector(x, work);
}
EDGEWISE_FN work_bits toBits(work x) {
    return __builtin_convertvector(x, work_bits);
}
#endif

EDGEWISE_FN work splatWork(work_number number) {
    return work{} + number;
}
EDGEWISE_FN work_number numberOf(double x) {
    return static_cast<work_number>(x);
}

#ifdef EDGEWISE_FP32
/// floor(log2 x) of a normal x > 0.
EDGEWISE_FN work exponentOf(work x) {
    return fromBits((__builtin_bit_cast(work_bits, x) >> 23) - 127);
}

/// 2^k for an integer |k| <= 126.
EDGEWISE_FN work exp2Int(work k) {
    return __builtin_bit_cast(work, (toBits(k) + 127) << 23);
}
#endif
