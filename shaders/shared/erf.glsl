// The error function from + - * / alone; includes after transcendental.glsl. [E14]

/// erf(x) / x - 1 in z = x^2 on |x| <= 1; fit error 2^-68.
EDGEWISE_FN real erfTail(real z) {
    EDGEWISE_PRECISE real p = z * EDGEWISE_REAL(-4.222898898727847e-12) + EDGEWISE_REAL(8.703791796635955e-11);
    p = p * z + EDGEWISE_REAL(-1.2163042541408398e-09);
    p = p * z + EDGEWISE_REAL(1.4792145869174777e-08);
    p = p * z + EDGEWISE_REAL(-1.6364614435560966e-07);
    p = p * z + EDGEWISE_REAL(1.6462043408949137e-06);
    p = p * z + EDGEWISE_REAL(-1.4925647465183309e-05);
    p = p * z + EDGEWISE_REAL(0.00012055332899360506);
    p = p * z + EDGEWISE_REAL(-0.0008548327021853268);
    p = p * z + EDGEWISE_REAL(0.005223977625422087);
    p = p * z + EDGEWISE_REAL(-0.026866170645129733);
    p = p * z + EDGEWISE_REAL(0.11283791670955119);
    p = p * z + EDGEWISE_REAL(-0.37612638903183754);
    EDGEWISE_PRECISE real result = p * z + EDGEWISE_REAL(0.12837916709551259);
    return result;
}

/// erfc(x) e^(x^2) on 1 <= x <= 6 in t = (x - 2)/(x + 2); fit error 2^-56.5, relative.
EDGEWISE_FN real scaledErfc(real t) {
    EDGEWISE_PRECISE real p = t * EDGEWISE_REAL(-1.1852643306921518e-06) + EDGEWISE_REAL(1.342982772532023e-06);
    p = p * t + EDGEWISE_REAL(4.000002785392327e-06);
    p = p * t + EDGEWISE_REAL(1.281993567779663e-06);
    p = p * t + EDGEWISE_REAL(-1.3988879054027866e-05);
    p = p * t + EDGEWISE_REAL(-2.7559338615399275e-05);
    p = p * t + EDGEWISE_REAL(2.7525455568332002e-05);
    p = p * t + EDGEWISE_REAL(0.00017435934527080233);
    p = p * t + EDGEWISE_REAL(4.3555731464324277e-05);
    p = p * t + EDGEWISE_REAL(-0.0009819769416730096);
    p = p * t + EDGEWISE_REAL(-0.0008471432591331789);
    p = p * t + EDGEWISE_REAL(0.006997461737168785);
    p = p * t + EDGEWISE_REAL(0.0037328924045225364);
    p = p * t + EDGEWISE_REAL(-0.07897858101571043);
    p = p * t + EDGEWISE_REAL(0.24165819424246487);
    p = p * t + EDGEWISE_REAL(-0.4271858474139585);
    EDGEWISE_PRECISE real result = p * t + EDGEWISE_REAL(0.25539567631050575);
    return result;
}

/// erf(x). Error <= 2 ulp.
EDGEWISE_FN real erfReal(real x) {
    real ax = smaller(absolute(x), splat(EDGEWISE_REAL(6.0)));
    EDGEWISE_PRECISE real near = ax + ax * erfTail(ax * ax);
    EDGEWISE_PRECISE real t = (ax - EDGEWISE_REAL(2.0)) / (ax + EDGEWISE_REAL(2.0));
    EDGEWISE_PRECISE real far = EDGEWISE_REAL(1.0) - expNegative(ax * ax) * scaledErfc(t);
    real e = ax < EDGEWISE_REAL(1.0) ? near : far;
    return x < EDGEWISE_REAL(0.0) ? -e : e;
}
