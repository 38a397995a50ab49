// A visible segment and its line as a sample sees them. In double whatever the precision of what follows: distance, clip
// points and the order of crossings. [E2] Needs SeenEdge, an EdgeInput
// of numbers that are `real`: analytic/edge_lanes.inl, or edge_input.glsl.

struct Line {
    real h;                   // signed distance of the line, px
    real a_x, a_y, b_x, b_y;  // the ends relative to the sample: functions of the end and the sample alone
    real t_a, t_b;            // along the direction from the foot point
    real len, d_x, d_y;
};

/// Where a segment crosses the support's border. [E12], [E13]
struct BorderPoint {
    mask crossed;
    work position;  // radial: its angle over 2 pi in (-1/2, 1/2]; separable: K(y) on the side x = R
    real order;     // increases along the border: turns, or y in px
    real doubt;     // how far rounding may have moved `order`
    real spread;    // orders segments that part at a vertex: along the border over across it
};

/// What one sample sees of one segment.
struct EdgeTerm {
    mask touched;
    work value;               // before it is rounded to fixed point
    BorderPoint entry, exit;  // on the way from a to b
};

EDGEWISE_FN Line lineAt(EDGEWISE_IN(SeenEdge) seen, real x, real y) {
    Line line;
    real dx = x - seen.origin_x;  // exact: both are multiples of 2^-32 below 2^21
    real dy = y - seen.origin_y;
    dd nx = dd(EDGEWISE_INIT seen.nx_hi, seen.nx_lo EDGEWISE_END);
    dd ny = dd(EDGEWISE_INIT seen.ny_hi, seen.ny_lo EDGEWISE_END);
    dd c = dd(EDGEWISE_INIT seen.c_hi, seen.c_lo EDGEWISE_END);
    dd crossed = ddAdd(ddMulReal(nx, dx), ddMulReal(ny, dy));
    mask apart = EDGEWISE_EITHER(seen.c_hi != EDGEWISE_REAL(0.0), seen.c_lo != EDGEWISE_REAL(0.0));
    if (anyLane(apart)) crossed = ddAdd(crossed, c);  // + 0 keeps the bits
    line.h = crossed.hi / seen.line_length;
    real a_x = seen.a_x - x;  // exact, as the next three
    real a_y = seen.a_y - y;
    real b_x = seen.b_x - x;
    real b_y = seen.b_y - y;
    line.a_x = a_x + seen.a_rest_x;
    line.a_y = a_y + seen.a_rest_y;
    line.b_x = b_x + seen.b_rest_x;
    line.b_y = b_y + seen.b_rest_y;
    line.d_x = seen.direction_x;
    line.d_y = seen.direction_y;
    line.t_a = (a_x * line.d_x + a_y * line.d_y) + (seen.a_rest_x * line.d_x + seen.a_rest_y * line.d_y);
    line.t_b = (b_x * line.d_x + b_y * line.d_y) + (seen.b_rest_x * line.d_x + seen.b_rest_y * line.d_y);
    line.len = seen.len;
    return line;
}

/// A number near 0 that can be divided by.
EDGEWISE_FN real nonZero(real d) {
    real tiny = splat(EDGEWISE_REAL(3.8725919148493183e-121));
    return absolute(d) < tiny ? (d < EDGEWISE_REAL(0.0) ? -tiny : tiny) : d;
}

EDGEWISE_FN BorderPoint noCrossing() {
    BorderPoint none;
    none.crossed = splat(EDGEWISE_REAL(1.0)) < EDGEWISE_REAL(0.0);
    none.position = splatWork(EDGEWISE_WORK(0.0));
    none.order = none.doubt = none.spread = splat(EDGEWISE_REAL(0.0));
    return none;
}

/// Along over across, with the sign that it has on the way through the border from the segment's nearer end.
EDGEWISE_FN real spreadFrom(EDGEWISE_IN(Line) line, real t, real slope, real in_a, real in_b) {
    real in_near = t - line.t_a < line.t_b - t ? in_a : in_b;
    return in_near > EDGEWISE_REAL(0.5) ? slope : -slope;
}
