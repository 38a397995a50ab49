// What the shared text needs of a `real`: one double, or 2, 4, 8 samples at once. Included inside a
// namespace, so that functions compiled for one instruction set are never linked into another: define
// EDGEWISE_LANES first, and include <immintrin.h> outside where EDGEWISE_X86 is defined. No include guard:
// each instruction set has its own copy.

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

EDGEWISE_FN bool any(mask m) {
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
