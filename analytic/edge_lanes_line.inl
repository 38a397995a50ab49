// The segment and its line as the samples see them. [E2]

struct Line {
    real h;                     // signed distance of the line, px
    real a_x, a_y, b_x, b_y;    // the ends relative to the sample: functions of the end and the sample alone
    real t_a, t_b;              // along the direction from the foot point
    real length, d_x, d_y;
};

EDGEWISE_FN Line lineAt(const EdgeInput& in, int first) {
    const real x = (in.sample_x + first) + laneNumbers();  // exact
    const real y = splat(in.sample_y);
    const real dx = x - in.origin_x, dy = y - in.origin_y;  // exact: both are multiples of 2^-32 below 2^21
    const dd nx = {splat(in.nx_hi), splat(in.nx_lo)}, ny = {splat(in.ny_hi), splat(in.ny_lo)};
    const dd c = {splat(in.c_hi), splat(in.c_lo)};
    dd cross = ddAdd(ddMulReal(nx, dx), ddMulReal(ny, dy));
    if (in.c_hi != 0.0 || in.c_lo != 0.0) cross = ddAdd(cross, c);  // adding 0 would leave the bits as they are
    Line line;
    line.h = cross.hi / in.line_length;
    const real a_x = in.a_x - x, a_y = in.a_y - y, b_x = in.b_x - x, b_y = in.b_y - y;  // exact
    line.a_x = a_x + in.a_rest_x;
    line.a_y = a_y + in.a_rest_y;
    line.b_x = b_x + in.b_rest_x;
    line.b_y = b_y + in.b_rest_y;
    line.d_x = splat(in.direction_x);
    line.d_y = splat(in.direction_y);
    line.t_a = (a_x * line.d_x + a_y * line.d_y) + (in.a_rest_x * line.d_x + in.a_rest_y * line.d_y);
    line.t_b = (b_x * line.d_x + b_y * line.d_y) + (in.b_rest_x * line.d_x + in.b_rest_y * line.d_y);
    line.length = splat(in.length);
    return line;
}

/// Round to the nearest 2^-60; |x| < 8.
EDGEWISE_FN bits toFixed(real x) {
    const real scaled = x * 0x1p60;
    const real size = absolute(scaled);
    const real rounded = size < 0x1p52 ? (size + 0x1p52) - 0x1p52 : size;
    const real signed_value = scaled < 0.0 ? -rounded : rounded;
    return truncated(signed_value);
}

/// Terms below 2^-1000 are 0, though fixed point would see to it: the rule is the same on every device.
EDGEWISE_FN real flushTiny(real x) { return absolute(x) < 0x1p-1000 ? splat(0.0) : x; }

EDGEWISE_FN void store(bits value, int first, std::int64_t* out) { __builtin_memcpy(out + first, &value, sizeof value); }
EDGEWISE_FN void store(real value, int first, double* out) { __builtin_memcpy(out + first, &value, sizeof value); }

EDGEWISE_FN unsigned laneSet(mask m, int first) { return laneSet(m) << first; }

/// A number near 0 that can be divided by.
EDGEWISE_FN real nonZero(real d) { return absolute(d) < 0x1p-400 ? (d < 0.0 ? splat(-0x1p-400) : splat(0x1p-400)) : d; }

/// Along over across, with the sign that it has on the way through the border from the segment's nearer end.
EDGEWISE_FN real spreadFrom(const Line& line, real t, real slope, real in_a, real in_b) {
    const real in_near = t - line.t_a < line.t_b - t ? in_a : in_b;
    return in_near > 0.5 ? slope : -slope;
}

/// Whether the segment's box meets the box of the supports of the lanes from `first` on; rounding has its margin.
EDGEWISE_FN bool boxesMeet(const EdgeInput& in, double radius, int first) {
    const double reach = radius * (1 + 0x1p-40) + 0x1p-32;
    const double x0 = in.sample_x + first - reach, x1 = in.sample_x + (first + EDGEWISE_LANES - 1) + reach;
    const double y0 = in.sample_y - reach, y1 = in.sample_y + reach;
    return !((in.a_x < x0 && in.b_x < x0) || (in.a_x > x1 && in.b_x > x1) || (in.a_y < y0 && in.b_y < y0) ||
             (in.a_y > y1 && in.b_y > y1));
}
