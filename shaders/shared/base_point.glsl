// Who owns the support's border when nothing crosses it, though a segment touches the point B = (sample.x + R, sample.y)
// where the caller looks owners up. [E15] Needs EdgeInput and real = double.

struct BasePoint {
    double distance2;  // of the nearest segment from B, px^2
    double cosine;     // of its angle at its nearest point with the way to the border: nearer wins
    uint owner;
};

/// Callers look up owners by coordinates in double, of up to 2^20 px: they cannot be wrong farther from a segment than
/// 2^-31 px.
const double kLookupPx = EDGEWISE_REAL(4.656612873077393e-10);

/// B and a vertex nearer than 2^-50 px are one point: their coordinates relative to the sample carry two roundings. A
/// segment no longer than that is a point too, and has no side.
const double kOnePoint2 = EDGEWISE_REAL(7.888609052210118e-31);

EDGEWISE_FN BasePoint noBasePoint() { return BasePoint(EDGEWISE_INIT EDGEWISE_REAL(1e300), EDGEWISE_REAL(-2.0), 0xffffffffu EDGEWISE_END); }
EDGEWISE_FN bool isKnown(EDGEWISE_IN(BasePoint) base) { return base.distance2 < EDGEWISE_REAL(1e300); }

/// The sign of cross(a - sample, b - sample), from the line.
EDGEWISE_FN double sideOfSample(EDGEWISE_IN(EdgeInput) seen, double x, double y) {
    dd along_x = ddMulReal(dd(EDGEWISE_INIT seen.nx_hi, seen.nx_lo EDGEWISE_END), x - seen.origin_x);
    dd along_y = ddMulReal(dd(EDGEWISE_INIT seen.ny_hi, seen.ny_lo EDGEWISE_END), y - seen.origin_y);
    return ddAdd(ddAdd(along_x, along_y), dd(EDGEWISE_INIT seen.c_hi, seen.c_lo EDGEWISE_END)).hi;
}

EDGEWISE_FN bool isNearer(EDGEWISE_IN(BasePoint) p, EDGEWISE_IN(BasePoint) q) {
    if (p.distance2 != q.distance2) return p.distance2 < q.distance2;
    if (p.cosine != q.cosine) return p.cosine > q.cosine;
    return p.owner < q.owner;
}

/// Takes the segment into account, as the sample at (x, y) sees it; the result does not depend on the order of the calls.
EDGEWISE_FN void considerBase(EDGEWISE_INOUT(BasePoint) base, bool radial, double R, EDGEWISE_IN(EdgeInput) seen, double x,
                              double y, uint left, uint right) {
    if (seen.len * seen.len <= kOnePoint2) return;
    double a_x = (seen.a_x - x) + seen.a_rest_x;
    double a_y = (seen.a_y - y) + seen.a_rest_y;
    double b_x = (seen.b_x - x) + seen.b_rest_x;
    double b_y = (seen.b_y - y) + seen.b_rest_y;
    double near = smaller(kLookupPx, R * EDGEWISE_REAL(9.5367431640625e-07));
    double t = (R - a_x) * seen.direction_x + -a_y * seen.direction_y;
    double across = (R - a_x) * seen.direction_y - -a_y * seen.direction_x;
    // A shared vertex at B is an end of each of its segments, and equally near, whatever t rounds to.
    double a2 = (R - a_x) * (R - a_x) + a_y * a_y;
    double b2 = (R - b_x) * (R - b_x) + b_y * b_y;
    bool first = a2 < b2;
    double end2 = first ? a2 : b2;
    bool at_end = t <= EDGEWISE_REAL(0.0) || t >= seen.len || end2 <= kOnePoint2;
    double nearest2 = at_end ? end2 : across * across;
    double distance2 = nearest2 <= kOnePoint2 ? EDGEWISE_REAL(0.0) : nearest2;
    if (!(distance2 <= near * near)) return;
    // both ends inside the support, or both outside; one each: it crosses the border, and its crossing tells
    bool a_inside = radial ? a_x * a_x + a_y * a_y <= R * R : !(a_x > R);
    bool b_inside = radial ? b_x * b_x + b_y * b_y <= R * R : !(b_x > R);
    if (a_inside != b_inside) return;
    // the border lies beyond the segment (+x) when it is inside, else on its near side
    double way = a_inside ? EDGEWISE_REAL(1.0) : EDGEWISE_REAL(-1.0);
    double cosine = at_end ? way * (first ? seen.direction_x : -seen.direction_x) : EDGEWISE_REAL(0.0);
    bool sample_is_left = radial ? sideOfSample(seen, x, y) > EDGEWISE_REAL(0.0) : true;
    BasePoint fresh = BasePoint(EDGEWISE_INIT distance2, cosine, sample_is_left != a_inside ? left : right EDGEWISE_END);
    if (isNearer(fresh, base)) base = fresh;
}
