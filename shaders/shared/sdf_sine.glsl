// Sine and cosine for SDFs, alike on every device: built-ins of GLSL may be off by 2^-11.

/// From     Taylor's series to r^21 about the nearest multiple of pi, r in [-pi/2, pi/2]: cut off below 1.3e-18.
/// Error    a few units of the last place of 1, plus |x| units of it: pi is three parts, of which the first two times k
///          are exact for |k| < 2^13 in float, < 2^42 in double.
EDGEWISE_FN real sine(real x) {
    real k = floor(x * real(0.31830988618379067154) + real(0.5));
    real r = x - k * real(3.140625);
    r = r - k * real(0.000967502593994140625);
    r = r - k * real(1.5099579909783764338e-7);
    real r2 = r * r;
    real p = real(1.9572941063391261231e-20);
    p = real(-8.2206352466243297170e-18) + r2 * p;
    p = real(2.8114572543455207632e-15) + r2 * p;
    p = real(-7.6471637318198164759e-13) + r2 * p;
    p = real(1.6059043836821614599e-10) + r2 * p;
    p = real(-2.5052108385441718775e-8) + r2 * p;
    p = real(2.7557319223985890653e-6) + r2 * p;
    p = real(-1.9841269841269841270e-4) + r2 * p;
    p = real(8.3333333333333333333e-3) + r2 * p;
    p = real(-1.6666666666666666667e-1) + r2 * p;
    real value = r + r * (r2 * p);
    real odd = k - real(2.0) * floor(real(0.5) * k);
    return value - real(2.0) * odd * value;
}
EDGEWISE_FN real cosine(real x) {
    return sine(x + real(1.57079632679489661923));
}
