// What the edge terms need of elementary functions in float: overloads of transcendental.glsl's on `work`, by the same
// reductions with shorter fits. [E14] Needs work_mask, splatWork(), exponentOf(), exp2Int() for float.

EDGEWISE_FN work smaller(work a, work b) { return a < b ? a : b; }
EDGEWISE_FN work larger(work a, work b) { return a < b ? b : a; }
EDGEWISE_FN work absolute(work a) { return a < EDGEWISE_WORK(0.0) ? -a : a; }

/// The integer nearest to x, |x| < 2^22, ties to even.
EDGEWISE_FN work nearestInteger(work x) {
    EDGEWISE_PRECISE work s = x + EDGEWISE_WORK(12582912.0);
    EDGEWISE_PRECISE work result = s - EDGEWISE_WORK(12582912.0);
    return result;
}

/// (1 - e^-r) / r for |r| <= ln 2 / 2; fit error 2^-28.7, relative.
EDGEWISE_FN work phi1Near0(work r) {
    EDGEWISE_PRECISE work p = r * EDGEWISE_WORK(0.00019841245375573635) + EDGEWISE_WORK(-0.0013941004872322083);
    p = p * r + EDGEWISE_WORK(0.008333402685821056);
    p = p * r + EDGEWISE_WORK(-0.04166635498404503);
    p = p * r + EDGEWISE_WORK(0.1666666567325592);
    p = p * r + EDGEWISE_WORK(-0.5);
    EDGEWISE_PRECISE work result = p * r + EDGEWISE_WORK(1.0);
    return result;
}

/// v - k ln 2: k times the first part is exact for |k| < 2^9.
EDGEWISE_FN work lessLn2(work v, work k) {
    EDGEWISE_PRECISE work r = v - k * EDGEWISE_WORK(0.693145751953125);
    EDGEWISE_PRECISE work result = r - k * EDGEWISE_WORK(1.428606765330187e-06);
    return result;
}

/// (1 - e^-v) / v, v >= 0.
EDGEWISE_FN work phi1(work v) {
    work w = smaller(v, splatWork(EDGEWISE_WORK(80.0)));
    EDGEWISE_PRECISE work k = nearestInteger(w * EDGEWISE_WORK(1.442695));
    work r = lessLn2(w, k);
    work near0 = phi1Near0(r);
    EDGEWISE_PRECISE work scale = exp2Int(-k);
    EDGEWISE_PRECISE work top = (EDGEWISE_WORK(1.0) - scale) + scale * (r * near0);
    EDGEWISE_PRECISE work result = k < EDGEWISE_WORK(0.5) ? near0 : top / v;
    return result;
}

/// atanh(f) / f - 1 over f^2, z = f^2, |f| <= 0.1733; fit error 2^-30 of the whole.
EDGEWISE_FN work atanhTail(work z) {
    EDGEWISE_PRECISE work p = z * EDGEWISE_WORK(0.14948223531246185) + EDGEWISE_WORK(0.1998835802078247);
    EDGEWISE_PRECISE work result = p * z + EDGEWISE_WORK(0.33333390951156616);
    return result;
}

/// atanh(part / whole) for 0 <= part < whole, given rest = whole - part to full relative accuracy.
EDGEWISE_FN work atanhOfParts(work part, work whole, work rest) {
    EDGEWISE_PRECISE work k = exponentOf((whole + part) / rest * EDGEWISE_WORK(1.4142135));
    EDGEWISE_PRECISE work scaled = exp2Int(k) * rest;
    EDGEWISE_PRECISE work sum = whole + part;
    EDGEWISE_PRECISE work f = k < EDGEWISE_WORK(0.5) ? part / whole : (sum - scaled) / (sum + scaled);
    EDGEWISE_PRECISE work z = f * f;
    EDGEWISE_PRECISE work t = f + f * (z * atanhTail(z));
    EDGEWISE_PRECISE work result = k * EDGEWISE_WORK(0.34657359) + t;
    return result;
}

/// atan(q) / q - 1 over q^2, z = q^2, |q| <= tan(pi/8); fit error 2^-28.8 of the whole.
EDGEWISE_FN work atanTail(work z) {
    EDGEWISE_PRECISE work p = z * EDGEWISE_WORK(-0.060844648629426956) + EDGEWISE_WORK(0.10596451163291931);
    p = p * z + EDGEWISE_WORK(-0.14243918657302856);
    p = p * z + EDGEWISE_WORK(0.19998493790626526);
    EDGEWISE_PRECISE work result = p * z + EDGEWISE_WORK(-0.33333316445350647);
    return result;
}

/// The angle of (x, y) in (-pi, pi]; atan2(0, 0) = 0, a zero has no sign.
EDGEWISE_FN work atan2Real(work y, work x) {
    work ax = absolute(x);
    work ay = absolute(y);
    work_mask steep = ax < ay;
    work big = steep ? ay : ax;
    work small = steep ? ax : ay;
    big = big < EDGEWISE_WORK(1e-37) ? splatWork(EDGEWISE_WORK(1e-37)) : big;
    work_mask far = small > EDGEWISE_WORK(0.41421356) * big;
    EDGEWISE_PRECISE work top = far ? small - big : small;
    EDGEWISE_PRECISE work bottom = far ? small + big : big;
    EDGEWISE_PRECISE work q = top / bottom;
    work eighths = far ? splatWork(EDGEWISE_WORK(1.0)) : splatWork(EDGEWISE_WORK(0.0));  // of a turn, + atan q
    eighths = steep ? EDGEWISE_WORK(2.0) - eighths : eighths;
    q = steep ? -q : q;
    eighths = x < EDGEWISE_WORK(0.0) ? EDGEWISE_WORK(4.0) - eighths : eighths;
    q = x < EDGEWISE_WORK(0.0) ? -q : q;
    // eighths * pi/4 as hi + lo: hi has 20 bits, so that the product is exact
    EDGEWISE_PRECISE work hi = eighths * EDGEWISE_WORK(0.7853975296020508);
    EDGEWISE_PRECISE work lo = eighths * EDGEWISE_WORK(6.337954232549237e-07);
    EDGEWISE_PRECISE work z = q * q;
    EDGEWISE_PRECISE work angle = hi + (lo + (q + q * (z * atanTail(z))));
    return y < EDGEWISE_WORK(0.0) ? -angle : angle;
}
