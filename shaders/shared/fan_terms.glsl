// The inside part of a fan term: F_in = h L' mean(g), g(p) = int_0^1 u W(u p) du, positive for a positive kernel. [E3]
// A piece of a line at signed distance h from the sample runs from t1 to t2, its length is given apart. Positions in px.

// keeps quotients of zeros finite: their terms are multiplied by 0
#ifdef EDGEWISE_FP32
const work_number kTiny = EDGEWISE_WORK(1e-30);
#else
const work_number kTiny = EDGEWISE_WORK(1e-280);
#endif

/// Half the chord that a circle of radius R cuts from the line, 0 when they do not meet. [E4]
#define EDGEWISE_HALF_CHORD(type)                        \
    EDGEWISE_FN type halfChord(type h, type R) {         \
        type square = (R - absolute(h)) * (R + absolute(h)); \
        return sqrt(larger(square, R - R));              \
    }
EDGEWISE_HALF_CHORD(real)
#ifdef EDGEWISE_FP32
EDGEWISE_HALF_CHORD(work)
#endif

/// The signed angle at the sample of the piece [t1, t2], `len` px long, at one side of the foot point. [E5]
EDGEWISE_FN work subtendedAngle(work h, work t1, work t2, work len) {
    EDGEWISE_PRECISE work y = h * len;
    EDGEWISE_PRECISE work x = h * h + t1 * t2;
    return atan2Real(y, x);
}

/// r + t for r = sqrt(h^2 + t^2), without cancellation.
EDGEWISE_FN work radiusPlus(work r, work t, work h) {
    EDGEWISE_PRECISE work near = h * h / larger(r - t, splatWork(kTiny));
    EDGEWISE_PRECISE work far = r + t;
    return t < EDGEWISE_WORK(0.0) ? near : far;
}

/// Mean of 1/2 - r/(3R) over the piece: the cone's g without its factor 3/(pi R^2), in [1/6, 1/2]. [E7]
EDGEWISE_FN work coneMean(work h, work t1, work t2, work len, work R) {
    EDGEWISE_PRECISE work r1 = sqrt(h * h + t1 * t1);
    EDGEWISE_PRECISE work r2 = sqrt(h * h + t2 * t2);
    EDGEWISE_PRECISE work s = larger(r1 + r2, splatWork(kTiny));
    work part = smaller(len, s);
    EDGEWISE_PRECISE work rest = larger(radiusPlus(r1, t1, h) + radiusPlus(r2, -t2, h), splatWork(kTiny));
    EDGEWISE_PRECISE work inverse = EDGEWISE_WORK(2.0) * atanhOfParts(part, s, rest) / larger(part, splatWork(kTiny));
    EDGEWISE_PRECISE work m = t1 + t2;
    EDGEWISE_PRECISE work ends = EDGEWISE_WORK(0.5) * (s + m * m / s);
    EDGEWISE_PRECISE work mean_r = EDGEWISE_WORK(0.5) * (ends + h * h * inverse);
    EDGEWISE_PRECISE work result = EDGEWISE_WORK(0.5) - mean_r / (EDGEWISE_WORK(3.0) * R);
    return result;
}
