// Which weight tiles a segment may touch. Always in doubles; what rounding leaves in doubt counts as touched.

/// More than 2^-30 px: that near a support, a segment is wanted.
const double kReachSlackPx = EDGEWISE_REAL(1.862645149230957e-09);

struct Span {
    double low;
    double high;
};
/// Empty where first > last.
struct TileSpan {
    int first;
    int last;
};

/// dx/dy, a.y <= b.y; 0 for a horizontal.
EDGEWISE_FN double slopeOf(double ax, double ay, double bx, double by) {
    EDGEWISE_PRECISE double slope = by - ay > 0.0 ? (bx - ax) / (by - ay) : 0.0;
    return slope;
}

/// The abscissae of the part of a -> b, whose slope slopeOf() gives, within [y0, y1], widened by the grid's 2^-32 px, more than rounding may lose;
/// empty: low > high.
EDGEWISE_FN Span spanAlong(double ax, double ay, double bx, double by, double slope, double y0, double y1) {
    if (ay > y1 || by < y0) return Span(EDGEWISE_INIT EDGEWISE_REAL(1.0), EDGEWISE_REAL(0.0) EDGEWISE_END);
    double xa = ax, xb = bx;
    if (by - ay > 0.0) {
        EDGEWISE_PRECISE double x_at_y0 = ax + slope * (y0 - ay);
        EDGEWISE_PRECISE double x_at_y1 = ax + slope * (y1 - ay);
        if (ay < y0) xa = x_at_y0;
        if (by > y1) xb = x_at_y1;
    }
    double grid_px = EDGEWISE_REAL(2.3283064365386963e-10);
    return Span(EDGEWISE_INIT max(min(ax, bx), min(xa, xb)) - grid_px,
                min(max(ax, bx), max(xa, xb)) + grid_px EDGEWISE_END);
}

EDGEWISE_FN Span spanWithin(double ax, double ay, double bx, double by, double y0, double y1) {
    return spanAlong(ax, ay, bx, by, slopeOf(ax, ay, bx, by), y0, y1);
}

/// Columns, or rows, of the lattice whose samples lie within [low, high].
EDGEWISE_FN TileSpan tileSpan(double low, double high, int origin_px, int side_px, int count) {
    double first = floor(((low - 0.5) - double(origin_px)) / double(side_px));
    double last = floor(((high - 0.5) - double(origin_px)) / double(side_px));
    if (last < 0.0 || first >= double(count)) return TileSpan(EDGEWISE_INIT 0, -1 EDGEWISE_END);
    double end = double(count - 1);
    return TileSpan(EDGEWISE_INIT int(first < 0.0 ? 0.0 : first), int(last > end ? end : last) EDGEWISE_END);
}
