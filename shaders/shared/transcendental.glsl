// Elementary functions from + - * / and sqrt alone, so that every IEEE machine gives the same bits. No branches: a lane
// has the bits of the scalar. Polynomials are minimax fits; DERIVATIONS.md [E14] has the reductions and fit errors,
// tests/analytic/transcendental_test.cpp prints the worst error against the real function.
// Needs mask (bool, or one a lane), splat(), exponentOf(), exp2Int(): shared/real_bits.glsl, or real_lanes.h in C++.

EDGEWISE_FN real smaller(real a, real b) { return a < b ? a : b; }
EDGEWISE_FN real larger(real a, real b) { return a < b ? b : a; }
EDGEWISE_FN real absolute(real a) { return a < EDGEWISE_REAL(0.0) ? -a : a; }

/// (1 - e^-r) / r for |r| <= ln 2 / 2; fit error 2^-61.8, relative.
EDGEWISE_FN real phi1Near0(real r) {
    EDGEWISE_PRECISE real p = r * EDGEWISE_REAL(-2.0876687993071487e-09) + EDGEWISE_REAL(2.511008000956452e-08);
    p = p * r + EDGEWISE_REAL(-2.7557400424303915e-07);
    p = p * r + EDGEWISE_REAL(2.7557240826093827e-06);
    p = p * r + EDGEWISE_REAL(-2.480158717146258e-05);
    p = p * r + EDGEWISE_REAL(0.0001984126989010778);
    p = p * r + EDGEWISE_REAL(-0.001388888888896588);
    p = p * r + EDGEWISE_REAL(0.00833333333331959);
    p = p * r + EDGEWISE_REAL(-0.04166666666666649);
    p = p * r + EDGEWISE_REAL(0.1666666666666668);
    p = p * r + EDGEWISE_REAL(-0.5);
    EDGEWISE_PRECISE real result = p * r + EDGEWISE_REAL(1.0);
    return result;
}

/// The integer nearest to x, |x| < 2^51, ties to even.
EDGEWISE_FN real nearestInteger(real x) {
    EDGEWISE_PRECISE real s = x + EDGEWISE_REAL(6755399441055744.0);
    EDGEWISE_PRECISE real result = s - EDGEWISE_REAL(6755399441055744.0);
    return result;
}

/// v - k ln 2: k ln2_hi is exact for |k| < 2^20.
EDGEWISE_FN real lessLn2(real v, real k) {
    EDGEWISE_PRECISE real r = v - k * EDGEWISE_REAL(0.6931471803691238);
    EDGEWISE_PRECISE real result = r - k * EDGEWISE_REAL(1.9082149292705877e-10);
    return result;
}

/// e^-v for -709 <= v; 0 where it is below 2^-1000. Error <= 2 ulp.
EDGEWISE_FN real expNegative(real v) {
    real w = smaller(v, splat(EDGEWISE_REAL(700.0)));
    EDGEWISE_PRECISE real k = nearestInteger(w * EDGEWISE_REAL(1.4426950408889634));
    real r = lessLn2(w, k);
    EDGEWISE_PRECISE real e = (EDGEWISE_REAL(1.0) - r * phi1Near0(r)) * exp2Int(-k);
    return v < EDGEWISE_REAL(693.0) ? e : splat(EDGEWISE_REAL(0.0));
}

/// e^x for x <= 709, likewise.
EDGEWISE_FN real expReal(real x) { return expNegative(-x); }

/// (1 - e^-v) / v, v >= 0: positive, from 1 down to 1/v, never a difference of near numbers;
/// e^-v - 1 = -v phi1(v). Error <= 2.5 ulp.
EDGEWISE_FN real phi1(real v) {
    real w = smaller(v, splat(EDGEWISE_REAL(700.0)));
    EDGEWISE_PRECISE real k = nearestInteger(w * EDGEWISE_REAL(1.4426950408889634));
    real r = lessLn2(w, k);
    real near0 = phi1Near0(r);
    EDGEWISE_PRECISE real scale = exp2Int(-k);
    EDGEWISE_PRECISE real top = (EDGEWISE_REAL(1.0) - scale) + scale * (r * near0);
    EDGEWISE_PRECISE real result = k < EDGEWISE_REAL(0.5) ? near0 : top / v;
    return result;
}

/// atanh(f) / f - 1 over f^2, z = f^2, |f| <= 0.1733; fit error 2^-66 of the whole.
EDGEWISE_FN real atanhTail(real z) {
    EDGEWISE_PRECISE real p = z * EDGEWISE_REAL(0.0664784557222368) + EDGEWISE_REAL(0.06622504468077556);
    p = p * z + EDGEWISE_REAL(0.07693665349282154);
    p = p * z + EDGEWISE_REAL(0.09090884879417806);
    p = p * z + EDGEWISE_REAL(0.11111111364159532);
    p = p * z + EDGEWISE_REAL(0.14285714284230494);
    p = p * z + EDGEWISE_REAL(0.20000000000004356);
    EDGEWISE_PRECISE real result = p * z + EDGEWISE_REAL(0.33333333333333326);
    return result;
}

/// ln x for normal x > 0. Error <= 1 ulp.
EDGEWISE_FN real logReal(real x) {
    EDGEWISE_PRECISE real k = exponentOf(x * EDGEWISE_REAL(1.4142135623730951));
    EDGEWISE_PRECISE real f = x * exp2Int(-k) - EDGEWISE_REAL(1.0);
    EDGEWISE_PRECISE real s = f / (EDGEWISE_REAL(2.0) + f);
    EDGEWISE_PRECISE real z = s * s;
    EDGEWISE_PRECISE real half_square = EDGEWISE_REAL(0.5) * f * f;
    EDGEWISE_PRECISE real tail = EDGEWISE_REAL(2.0) * z * atanhTail(z);
    EDGEWISE_PRECISE real small = s * (half_square + tail) + k * EDGEWISE_REAL(1.9082149292705877e-10);
    EDGEWISE_PRECISE real result = k * EDGEWISE_REAL(0.6931471803691238) - ((half_square - small) - f);
    return result;
}

/// atanh(part / whole) for 0 <= part < whole, given rest = whole - part to full relative accuracy. Error <= 4 ulp.
EDGEWISE_FN real atanhOfParts(real part, real whole, real rest) {
    EDGEWISE_PRECISE real k = exponentOf((whole + part) / rest * EDGEWISE_REAL(1.4142135623730951));
    EDGEWISE_PRECISE real scaled = exp2Int(k) * rest;
    EDGEWISE_PRECISE real sum = whole + part;
    EDGEWISE_PRECISE real f = k < EDGEWISE_REAL(0.5) ? part / whole : (sum - scaled) / (sum + scaled);
    EDGEWISE_PRECISE real z = f * f;
    EDGEWISE_PRECISE real t = f + f * (z * atanhTail(z));
    EDGEWISE_PRECISE real result = k * EDGEWISE_REAL(0.34657359027997264) + t;
    return result;
}

/// atan(q) / q - 1 over q^2, z = q^2, |q| <= tan(pi/8); fit error 2^-64 of the whole.
EDGEWISE_FN real atanTail(real z) {
    EDGEWISE_PRECISE real p = z * EDGEWISE_REAL(0.015151829369401695) + EDGEWISE_REAL(-0.0334271693118281);
    p = p * z + EDGEWISE_REAL(0.04501280087968248);
    p = p * z + EDGEWISE_REAL(-0.05217774876564161);
    p = p * z + EDGEWISE_REAL(0.05876910180229762);
    p = p * z + EDGEWISE_REAL(-0.06666213550998494);
    p = p * z + EDGEWISE_REAL(0.07692281701964784);
    p = p * z + EDGEWISE_REAL(-0.09090908087809904);
    p = p * z + EDGEWISE_REAL(0.11111111086194306);
    p = p * z + EDGEWISE_REAL(-0.14285714285345305);
    p = p * z + EDGEWISE_REAL(0.1999999999999716);
    EDGEWISE_PRECISE real result = p * z + EDGEWISE_REAL(-0.33333333333333326);
    return result;
}

/// The angle of (x, y) in (-pi, pi]; atan2(0, 0) = 0, a zero has no sign. Error <= 2 ulp.
EDGEWISE_FN real atan2Real(real y, real x) {
    real ax = absolute(x);
    real ay = absolute(y);
    mask steep = ax < ay;
    real big = steep ? ay : ax;
    real small = steep ? ax : ay;
    big = big < EDGEWISE_REAL(1e-300) ? splat(EDGEWISE_REAL(1e-300)) : big;
    mask far = small > EDGEWISE_REAL(0.41421356237309503) * big;
    EDGEWISE_PRECISE real top = far ? small - big : small;
    EDGEWISE_PRECISE real bottom = far ? small + big : big;
    EDGEWISE_PRECISE real q = top / bottom;
    real eighths = far ? splat(EDGEWISE_REAL(1.0)) : splat(EDGEWISE_REAL(0.0));  // the result in eighths of a turn + atan q
    eighths = steep ? EDGEWISE_REAL(2.0) - eighths : eighths;
    q = steep ? -q : q;
    eighths = x < EDGEWISE_REAL(0.0) ? EDGEWISE_REAL(4.0) - eighths : eighths;
    q = x < EDGEWISE_REAL(0.0) ? -q : q;
    // eighths * pi/4 as hi + lo: hi has 50 bits, so that the product is exact
    EDGEWISE_PRECISE real hi = eighths * EDGEWISE_REAL(0.7853981633974483);
    EDGEWISE_PRECISE real lo = eighths * EDGEWISE_REAL(3.061616997868383e-17);
    EDGEWISE_PRECISE real z = q * q;
    dd sum = quickTwoSum(eighths < EDGEWISE_REAL(0.5) ? q : hi, eighths < EDGEWISE_REAL(0.5) ? splat(EDGEWISE_REAL(0.0)) : q);
    EDGEWISE_PRECISE real angle = sum.hi + (sum.lo + (lo + q * (z * atanTail(z))));
    return y < EDGEWISE_REAL(0.0) ? -angle : angle;
}
