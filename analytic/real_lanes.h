// What the shared text needs of a `real`: one double, or eight samples at once. Included inside a namespace, so that
// functions compiled for one instruction set are never linked into another: define EDGEWISE_LANES as 1 or 8 first.
// No include guard: each instruction set includes it into its own namespace.

#if EDGEWISE_LANES == 1
using real = double;
using mask = bool;
using bits = long;
EDGEWISE_FN bool any(mask m) { return m; }
EDGEWISE_FN real sqrt(real x) { return __builtin_sqrt(x); }
EDGEWISE_FN double laneOf(real x, int) { return x; }
EDGEWISE_FN bool laneIs(mask m, int) { return m; }
EDGEWISE_FN real laneNumbers() { return 0.0; }
#else
typedef double real __attribute__((vector_size(64)));
typedef long bits __attribute__((vector_size(64)));
using mask = decltype(real{} < real{});
EDGEWISE_FN bool any(mask m) {
    long all = 0;
    for (int i = 0; i < 8; ++i) all |= m[i];
    return all != 0;
}
EDGEWISE_FN real sqrt(real x) {
    real root;
    for (int i = 0; i < 8; ++i) root[i] = __builtin_sqrt(x[i]);
    return root;
}
EDGEWISE_FN double laneOf(real x, int i) { return x[i]; }
EDGEWISE_FN bool laneIs(mask m, int i) { return m[i] != 0; }
EDGEWISE_FN real laneNumbers() { return real{0, 1, 2, 3, 4, 5, 6, 7}; }
#endif

EDGEWISE_FN real splat(double number) { return real{} + number; }

/// floor(log2 x) of a normal x > 0. The exponent field, read as the low bits of 2^52 + field.
EDGEWISE_FN real exponentOf(real x) {
    bits field = (__builtin_bit_cast(bits, x) >> 52) | 0x4330000000000000;
    return __builtin_bit_cast(real, field) - (0x1p52 + 1023.0);
}

/// 2^k for an integer |k| <= 1022.
EDGEWISE_FN real exp2Int(real k) {
    return __builtin_bit_cast(real, __builtin_bit_cast(bits, k + (0x1p52 + 1023.0)) << 52);
}
