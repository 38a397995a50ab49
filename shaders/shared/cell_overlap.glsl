// Which cells a triangle may meet. Always in doubles: positions are multiples of 2^-32 px up to 2^20 px.

const int kMisses = 0;
const int kMeets = 1;   // may meet; never less for one that does
const int kCovers = 2;  // surely covers the cell

/// Where the cell lies of the edge a -> b: kCovers is inside. Cells are x0 < x <= x1, y0 < y <= y1; their true
/// borders lie 2^-34 px further.
EDGEWISE_FN int cellBesideEdge(double ax, double ay, double bx, double by, double x0, double y0, double x1,
                               double y1) {
    EDGEWISE_PRECISE double ex = bx - ax;
    EDGEWISE_PRECISE double ey = by - ay;
    EDGEWISE_PRECISE double lo_x = x0 - ax;
    EDGEWISE_PRECISE double lo_y = y0 - ay;
    EDGEWISE_PRECISE double hi_x = x1 - ax;
    EDGEWISE_PRECISE double hi_y = y1 - ay;
    // cross(e, p - a) over the corners p: the largest and the smallest
    EDGEWISE_PRECISE double highest = ex * (ex > 0.0 ? hi_y : lo_y) - ey * (ey > 0.0 ? lo_x : hi_x);
    EDGEWISE_PRECISE double lowest = ex * (ex > 0.0 ? lo_y : hi_y) - ey * (ey > 0.0 ? hi_x : lo_x);
    double size_x = abs(ex), size_y = abs(ey);
    double far_x = max(abs(lo_x), abs(hi_x)), far_y = max(abs(lo_y), abs(hi_y));
    // Two products and their difference round, 3 * 2^-53; the border is moved by 2^-34, counted twice.
    EDGEWISE_PRECISE double error = EDGEWISE_REAL(3.3306690738754696e-16) * (size_x * far_y + size_y * far_x) +
                                    (size_x + size_y) * EDGEWISE_REAL(1.1641532182693481e-10);
    return highest < -error ? kMisses : (lowest > error ? kCovers : kMeets);
}

/// Of the triangle with these corners, cross(b - a, c - a) > 0.
EDGEWISE_FN int cellOverlap(double ax, double ay, double bx, double by, double cx, double cy, double x0,
                            double y0, double x1, double y1) {
    if (max(ax, max(bx, cx)) <= x0 || min(ax, min(bx, cx)) > x1) return kMisses;
    if (max(ay, max(by, cy)) <= y0 || min(ay, min(by, cy)) > y1) return kMisses;
    int ab = cellBesideEdge(ax, ay, bx, by, x0, y0, x1, y1);
    if (ab == kMisses) return kMisses;
    int bc = cellBesideEdge(bx, by, cx, cy, x0, y0, x1, y1);
    if (bc == kMisses) return kMisses;
    return min(min(ab, bc), cellBesideEdge(cx, cy, ax, ay, x0, y0, x1, y1));
}

/// The cell of a lattice of `count` cells of 16 px that holds a coordinate, clamped to the lattice.
EDGEWISE_FN int clampedCell(double at_px, double origin_px, int count) {
    double cell = (at_px - origin_px) / 16.0;
    double last = double(max(0, count - 1));
    return int(cell < 0.0 ? 0.0 : (last < cell ? last : cell));
}

/// Columns, or rows, of the lattice that [low, high] meets; empty where first > last.
struct CellSpan {
    int first;
    int last;
};
EDGEWISE_FN CellSpan cellSpan(double low, double high, int origin_px, int count) {
    double origin = double(origin_px), end = double(origin_px + 16 * count);
    if (high <= origin || low > end) return CellSpan(EDGEWISE_INIT 0, -1 EDGEWISE_END);
    // A coordinate on a border belongs to the cell before it: step back by less than the grid.
    return CellSpan(EDGEWISE_INIT clampedCell(low - EDGEWISE_REAL(2.3283064365386963e-10), origin, count),
                    clampedCell(high, origin, count) EDGEWISE_END);
}
