// Depth planes about a cell's corner, compared with a floating-point filter: analytic/local_plane.h.

/// Roundings: two products, two sums for c; two products, two sums at the point; one in each moved coordinate.
EDGEWISE_FN LocalPlane localPlaneOf(EDGEWISE_IN(DepthPlane) p, uint plane, uint owner, dvec2 d, double reach_px) {
    double x = p.dz_dx * d.x, y = p.dz_dy * d.y;
    double size = abs(p.z_anchor) + abs(p.dz_dx) * (abs(d.x) + reach_px) + abs(p.dz_dy) * (abs(d.y) + reach_px);
    return LocalPlane(EDGEWISE_INIT p.dz_dx, p.dz_dy, p.z_anchor + (x + y),
                      EDGEWISE_REAL(8.881784197001252e-16) * size, plane, owner EDGEWISE_END);
}

EDGEWISE_FN double depthAt(EDGEWISE_IN(LocalPlane) p, double x, double y) { return p.c + (p.a * x + p.b * y); }

/// Compares p and q at (x, y) from the origin: 1 where p is surely in front, -1 where q is, 0 where rounding
/// leaves it open. Triangles of one plane, and pieces of one owner, are decided by index.
EDGEWISE_FN int filteredOrder(EDGEWISE_IN(LocalPlane) p, EDGEWISE_IN(LocalPlane) q, double x, double y) {
    double d = depthAt(p, x, y) - depthAt(q, x, y);
    double error = p.error + q.error;
    if (p.plane == q.plane) return p.owner < q.owner ? 1 : -1;
    return d > error ? 1 : (d < -error ? -1 : 0);
}

/// Whether p hides q on the whole cell of this size whose corner is their origin: its depth is greater at all
/// four corners. Borders are moved by 2^-34 px, counted twice.
EDGEWISE_FN bool hidesIn(EDGEWISE_IN(LocalPlane) a, EDGEWISE_IN(LocalPlane) b, dvec2 size) {
    double da = a.a - b.a, db = a.b - b.b;
    double lowest = (a.c - b.c) + min(EDGEWISE_REAL(0.0), da * size.x) + min(EDGEWISE_REAL(0.0), db * size.y);
    double moved = (abs(da) + abs(db)) * EDGEWISE_REAL(1.1641532182693481e-10);
    if (a.plane == b.plane) return a.owner < b.owner;
    return lowest > EDGEWISE_REAL(2.0) * (a.error + b.error) + moved;
}

/// Whether p - q has one certain sign over the whole cell, from lo to hi about the planes' origin.
EDGEWISE_FN bool ordered(EDGEWISE_IN(LocalPlane) p, EDGEWISE_IN(LocalPlane) q, dvec2 lo, dvec2 hi) {
    double da = p.a - q.a, db = p.b - q.b, c = p.c - q.c;
    double x0 = min(da * lo.x, da * hi.x), x1 = max(da * lo.x, da * hi.x);
    double y0 = min(db * lo.y, db * hi.y), y1 = max(db * lo.y, db * hi.y);
    double error = EDGEWISE_REAL(2.0) * (p.error + q.error);
    return c + (x0 + y0) > error || c + (x1 + y1) < -error;
}
