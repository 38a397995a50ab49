// The lines that carry visible segments, and the points where they meet: analytic/carrier.h. Needs fine_point.glsl.

EDGEWISE_FN double slopeOf(EDGEWISE_IN(Carrier) line) {
    return isEdge(line) ? (line.b.x - line.a.x) / (line.b.y - line.a.y) : -line.B.hi / line.A.hi;
}

/// The line where two planes are equal. Where it rises across a cell by less than the sweep can tell, it would
/// not run inside any: it counts as horizontal everywhere. 2^-71 of 1/16 px, the narrowest cell, is 2^-75 px; at a
/// corner of the screen the line moves by 2^-71 of the way from the anchor.
EDGEWISE_FN Carrier planesMeet(LineRef ref, EDGEWISE_IN(DepthPlane) p, EDGEWISE_IN(DepthPlane) q, dvec2 anchor) {
    Carrier line;
    line.ref = ref;
    line.a = line.b = dvec2(EDGEWISE_REAL(0.0), EDGEWISE_REAL(0.0));
    line.A = twoSum(p.dz_dx, -q.dz_dx);
    line.B = twoSum(p.dz_dy, -q.dz_dy);
    line.C = twoSum(p.z_anchor, -q.z_anchor);
    line.anchor = anchor;
    if (abs(line.A.hi) < EDGEWISE_REAL(4.235164736271502e-22) * abs(line.B.hi))
        line.A = dd(EDGEWISE_INIT EDGEWISE_REAL(0.0), EDGEWISE_REAL(0.0) EDGEWISE_END);
    return line;
}

/// Edges run from a to b with a.y < b.y, or a.x > b.x if horizontal.
EDGEWISE_FN Carrier edgeBetween(LineRef ref, dvec2 a, dvec2 b) {
    Carrier line;
    bool downward = a.y < b.y || (a.y == b.y && a.x > b.x);
    line.ref = ref;
    line.a = downward ? a : b;
    line.b = downward ? b : a;
    line.A = line.B = line.C = dd(EDGEWISE_INIT EDGEWISE_REAL(0.0), EDGEWISE_REAL(0.0) EDGEWISE_END);
    line.anchor = dvec2(EDGEWISE_REAL(0.0), EDGEWISE_REAL(0.0));
    return line;
}

EDGEWISE_FN dd depthDifference(EDGEWISE_IN(Carrier) line, dvec2 p) {
    dvec2 d = p - line.anchor;
    return ddAdd(ddAdd(ddMulReal(line.A, d.x), ddMulReal(line.B, d.y)), line.C);
}

/// The carrier's point at an ordinate (not for horizontal lines) or at an abscissa (not for vertical ones).
EDGEWISE_FN FinePoint pointAtY(EDGEWISE_IN(Carrier) line, FineCoordinate y) {
    dd above, below;
    double origin;
    if (isEdge(line)) {
        dvec2 e = line.b - line.a;
        above = ddMulReal(offsetFrom(y, line.a.y), e.x);
        below = ddFrom(e.y);
        origin = line.a.x;
    } else {
        above = ddNeg(ddAdd(ddMul(line.B, offsetFrom(y, line.anchor.y)), line.C));
        below = line.A;
        origin = line.anchor.x;
    }
    return finePoint(fineCoordinate(origin, ddDiv(above, below)), y);
}
EDGEWISE_FN FinePoint pointAtX(EDGEWISE_IN(Carrier) line, FineCoordinate x) {
    dd above, below;
    double origin;
    if (isEdge(line)) {
        dvec2 e = line.b - line.a;
        above = ddMulReal(offsetFrom(x, line.a.x), e.y);
        below = ddFrom(e.x);
        origin = line.a.y;
    } else {
        above = ddNeg(ddAdd(ddMul(line.A, offsetFrom(x, line.anchor.x)), line.C));
        below = line.B;
        origin = line.anchor.y;
    }
    return finePoint(x, fineCoordinate(origin, ddDiv(above, below)));
}

EDGEWISE_FN FinePoint pointOnEdge(EDGEWISE_IN(Carrier) edge, dd t) {
    dvec2 e = edge.b - edge.a;
    return finePoint(fineCoordinate(edge.a.x, ddMulReal(t, e.x)), fineCoordinate(edge.a.y, ddMulReal(t, e.y)));
}

EDGEWISE_FN bool strictlyApart(double p, double q) {
    return p != EDGEWISE_REAL(0.0) && q != EDGEWISE_REAL(0.0) && (p > EDGEWISE_REAL(0.0)) != (q > EDGEWISE_REAL(0.0));
}

/// p.a + (N / D) e: exact signs decide whether, exact numbers decide where. D = cross(f, p.a - q.a) - cross(f, p.b - q.a)
/// = cross(e, f).
EDGEWISE_FN bool crossEdges(EDGEWISE_IN(Carrier) p, EDGEWISE_IN(Carrier) q, EDGEWISE_OUT(FinePoint) point) {
    dvec2 e = p.b - p.a, f = q.b - q.a;
    point = gridPoint(p.a);
    if (!strictlyApart(crossSign(f, p.a - q.a), crossSign(f, p.b - q.a))) return false;
    if (!strictlyApart(crossSign(e, q.a - p.a), crossSign(e, q.b - p.a))) return false;
    point = pointOnEdge(p, ddDiv(crossValue(f, p.a - q.a), crossValue(e, f)));
    return true;
}

EDGEWISE_FN bool crossEdgeWithDepth(EDGEWISE_IN(Carrier) edge, EDGEWISE_IN(Carrier) depth,
                                    EDGEWISE_OUT(FinePoint) point) {
    dd fa = depthDifference(depth, edge.a), fb = depthDifference(depth, edge.b);
    point = gridPoint(edge.a);
    if (!strictlyApart(fa.hi, fb.hi)) return false;
    point = pointOnEdge(edge, ddDiv(fa, ddSub(fa, fb)));
    return true;
}

EDGEWISE_FN dd determinant2(dd a, dd b, dd c, dd d) { return ddSub(ddMul(a, d), ddMul(b, c)); }

/// Cramer's rule in double-double, about the anchor. Of nearly parallel lines it gives a point that may be off
/// along them: one coordinate is kept, and the first line gives the other.
EDGEWISE_FN bool crossDepths(EDGEWISE_IN(Carrier) p, EDGEWISE_IN(Carrier) q, EDGEWISE_OUT(FinePoint) point) {
    point = gridPoint(p.anchor);
    dd det = determinant2(p.A, p.B, q.A, q.B);
    if (det.hi == EDGEWISE_REAL(0.0)) return false;
    dd x = ddDiv(determinant2(p.B, p.C, q.B, q.C), det);
    dd y = ddDiv(determinant2(p.C, p.A, q.C, q.A), det);
    if (!(abs(x.hi) < EDGEWISE_REAL(1048576.0) && abs(y.hi) < EDGEWISE_REAL(1048576.0))) return false;
    bool steep = abs(p.A.hi) >= abs(p.B.hi);
    if (steep)
        point = pointAtY(p, fineCoordinate(p.anchor.y, y));
    else
        point = pointAtX(p, fineCoordinate(p.anchor.x, x));
    return true;
}

EDGEWISE_FN bool edgeBefore(EDGEWISE_IN(Carrier) p, EDGEWISE_IN(Carrier) q) {
    if (p.a.y != q.a.y) return p.a.y < q.a.y;
    if (p.a.x != q.a.x) return p.a.x < q.a.x;
    if (p.b.y != q.b.y) return p.b.y < q.b.y;
    return p.b.x < q.b.x;
}
