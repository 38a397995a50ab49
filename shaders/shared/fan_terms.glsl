// The inside part of a fan term: F_in = h L' mean(g), g(p) = int_0^1 u W(u p) du, positive for a positive kernel. [E3]
// A piece of a line at signed distance h from the sample runs from t1 to t2, its length is given apart. Positions in px.

#define EDGEWISE_TINY EDGEWISE_REAL(1e-280)  // keeps quotients of zeros finite: their terms are multiplied by 0

/// Half the chord that a circle of radius R cuts from the line, 0 when they do not meet. [E4]
EDGEWISE_FN real halfChord(real h, real R) {
    EDGEWISE_PRECISE real square = (R - absolute(h)) * (R + absolute(h));
    return sqrt(square > EDGEWISE_REAL(0.0) ? square : splat(EDGEWISE_REAL(0.0)));
}

/// The signed angle at the sample of the piece [t1, t2], `len` px long, at one side of the foot point. [E5]
EDGEWISE_FN real subtendedAngle(real h, real t1, real t2, real len) {
    EDGEWISE_PRECISE real y = h * len;
    EDGEWISE_PRECISE real x = h * h + t1 * t2;
    return atan2Real(y, x);
}

/// r + t for r = sqrt(h^2 + t^2), without cancellation.
EDGEWISE_FN real radiusPlus(real r, real t, real h) {
    EDGEWISE_PRECISE real near = h * h / larger(r - t, splat(EDGEWISE_TINY));
    EDGEWISE_PRECISE real far = r + t;
    return t < EDGEWISE_REAL(0.0) ? near : far;
}

/// Mean of 1/2 - r/(3R) over the piece: the cone's g without its factor 3/(pi R^2), in [1/6, 1/2]. [E7]
EDGEWISE_FN real coneMean(real h, real t1, real t2, real len, real R) {
    EDGEWISE_PRECISE real r1 = sqrt(h * h + t1 * t1);
    EDGEWISE_PRECISE real r2 = sqrt(h * h + t2 * t2);
    EDGEWISE_PRECISE real s = larger(r1 + r2, splat(EDGEWISE_TINY));
    real part = smaller(len, s);
    EDGEWISE_PRECISE real rest = larger(radiusPlus(r1, t1, h) + radiusPlus(r2, -t2, h), splat(EDGEWISE_TINY));
    EDGEWISE_PRECISE real inverse = EDGEWISE_REAL(2.0) * atanhOfParts(part, s, rest) / larger(part, splat(EDGEWISE_TINY));
    EDGEWISE_PRECISE real m = t1 + t2;
    EDGEWISE_PRECISE real ends = EDGEWISE_REAL(0.5) * (s + m * m / s);
    EDGEWISE_PRECISE real mean_r = EDGEWISE_REAL(0.5) * (ends + h * h * inverse);
    EDGEWISE_PRECISE real result = EDGEWISE_REAL(0.5) - mean_r / (EDGEWISE_REAL(3.0) * R);
    return result;
}
