// Between `real`, which decides, and `work`, in which terms are computed: double, or float with EDGEWISE_FP32. Numbers
// that float would keep as denormals, or lose, count as 0: the rule is the same on every device.

#ifdef EDGEWISE_FP32
EDGEWISE_FN work workOf(real x) {
    return toWork(absolute(x) < EDGEWISE_REAL(7.888609052210118e-31) ? splat(EDGEWISE_REAL(0.0)) : x);
}
EDGEWISE_FN real realOf(work x) { return toReal(x); }
EDGEWISE_FN work flushTiny(work x) {
    return absolute(x) < EDGEWISE_WORK(7.888609052210118e-31) ? splatWork(EDGEWISE_WORK(0.0)) : x;
}
EDGEWISE_FN work nonZeroWork(work d) {
    work tiny = splatWork(EDGEWISE_WORK(7.888609052210118e-31));
    return absolute(d) < tiny ? (d < EDGEWISE_WORK(0.0) ? -tiny : tiny) : d;
}
const work_number kFar = EDGEWISE_WORK(1e30);
#else
EDGEWISE_FN work workOf(real x) { return x; }
EDGEWISE_FN real realOf(work x) { return x; }
EDGEWISE_FN work flushTiny(work x) {
    return absolute(x) < EDGEWISE_WORK(9.332636185032189e-302) ? splatWork(EDGEWISE_WORK(0.0)) : x;
}
EDGEWISE_FN work nonZeroWork(work d) { return nonZero(d); }
const work_number kFar = EDGEWISE_WORK(1e300);
#endif

/// Rounded to the nearest 2^-60; |x| < 8.
EDGEWISE_FN bits toFixed(real x) {
    real scaled = x * EDGEWISE_REAL(1152921504606846976.0);
    real size = absolute(scaled);
    real whole = EDGEWISE_REAL(4503599627370496.0) + splat(EDGEWISE_REAL(0.0));
    real rounded = size < whole ? (size + whole) - whole : size;
    return truncated(scaled < EDGEWISE_REAL(0.0) ? -rounded : rounded);
}
