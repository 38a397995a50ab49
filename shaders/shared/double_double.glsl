// Error-free sums and products, and arithmetic on unevaluated sums hi + lo (about 106 bits).
// One text, compiled as double in C++ (scalar and as SIMD lanes) and as double in GLSL, where `precise` is
// needed: a compiler that reorders these sums destroys them. No overflow, no underflow below 2^-960.

struct dd {
    real hi;
    real lo;
};

/// a + b = hi + lo exactly (Knuth).
EDGEWISE_FN dd twoSum(real a, real b) {
    EDGEWISE_PRECISE real s = a + b;
    EDGEWISE_PRECISE real bb = s - a;
    EDGEWISE_PRECISE real e = (a - (s - bb)) + (b - bb);
    return dd(EDGEWISE_INIT s, e EDGEWISE_END);
}

/// The same for |a| >= |b| or a = 0 (Dekker).
EDGEWISE_FN dd quickTwoSum(real a, real b) {
    EDGEWISE_PRECISE real s = a + b;
    EDGEWISE_PRECISE real e = b - (s - a);
    return dd(EDGEWISE_INIT s, e EDGEWISE_END);
}

/// a * b = hi + lo exactly, without a fused multiply-add (Veltkamp and Dekker); |a|, |b| < 2^970.
EDGEWISE_FN dd twoProd(real a, real b) {
    EDGEWISE_PRECISE real p = a * b;
    EDGEWISE_PRECISE real ta = EDGEWISE_REAL(134217729.0) * a;
    EDGEWISE_PRECISE real ah = ta - (ta - a);
    EDGEWISE_PRECISE real al = a - ah;
    EDGEWISE_PRECISE real tb = EDGEWISE_REAL(134217729.0) * b;
    EDGEWISE_PRECISE real bh = tb - (tb - b);
    EDGEWISE_PRECISE real bl = b - bh;
    EDGEWISE_PRECISE real e = ((ah * bh - p) + ah * bl + al * bh) + al * bl;
    return dd(EDGEWISE_INIT p, e EDGEWISE_END);
}

/// Relative error <= 3 * 2^-106 (the accurate sum of Joldes, Muller, Popescu 2017, algorithm 6).
EDGEWISE_FN dd ddAdd(dd a, dd b) {
    dd s = twoSum(a.hi, b.hi);
    dd t = twoSum(a.lo, b.lo);
    s = quickTwoSum(s.hi, s.lo + t.hi);
    return quickTwoSum(s.hi, s.lo + t.lo);
}

EDGEWISE_FN dd ddNeg(dd a) { return dd(EDGEWISE_INIT -a.hi, -a.lo EDGEWISE_END); }
EDGEWISE_FN dd ddSub(dd a, dd b) { return ddAdd(a, ddNeg(b)); }
EDGEWISE_FN dd ddFrom(real a) { return dd(EDGEWISE_INIT a, a - a EDGEWISE_END); }

/// Relative error <= 7 * 2^-106 (ibid., algorithm 10).
EDGEWISE_FN dd ddMul(dd a, dd b) {
    dd p = twoProd(a.hi, b.hi);
    EDGEWISE_PRECISE real t = a.hi * b.lo + a.lo * b.hi;
    return quickTwoSum(p.hi, p.lo + t);
}

EDGEWISE_FN dd ddMulReal(dd a, real b) {
    dd p = twoProd(a.hi, b);
    EDGEWISE_PRECISE real t = a.lo * b;
    return quickTwoSum(p.hi, p.lo + t);
}

/// Long division, three quotient digits; relative error <= 2^-100, b != 0.
EDGEWISE_FN dd ddDiv(dd a, dd b) {
    EDGEWISE_PRECISE real q = a.hi / b.hi;
    dd r = ddSub(a, ddMulReal(b, q));
    EDGEWISE_PRECISE real q2 = r.hi / b.hi;
    r = ddSub(r, ddMulReal(b, q2));
    EDGEWISE_PRECISE real q3 = r.hi / b.hi;
    dd s = quickTwoSum(q, q2);
    return quickTwoSum(s.hi, s.lo + q3);
}
