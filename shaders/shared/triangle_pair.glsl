// Where two triangles, or a triangle and a cell or a point, lie on the screen: surely, or as far as rounding tells.

EDGEWISE_FN bool boxesOverlap(EDGEWISE_IN(ScreenTriangle) s, EDGEWISE_IN(ScreenTriangle) t) {
    double sx0 = min(s.p_px[0].x, min(s.p_px[1].x, s.p_px[2].x)), sx1 = max(s.p_px[0].x, max(s.p_px[1].x, s.p_px[2].x));
    double tx0 = min(t.p_px[0].x, min(t.p_px[1].x, t.p_px[2].x)), tx1 = max(t.p_px[0].x, max(t.p_px[1].x, t.p_px[2].x));
    double sy0 = min(s.p_px[0].y, min(s.p_px[1].y, s.p_px[2].y)), sy1 = max(s.p_px[0].y, max(s.p_px[1].y, s.p_px[2].y));
    double ty0 = min(t.p_px[0].y, min(t.p_px[1].y, t.p_px[2].y)), ty1 = max(t.p_px[0].y, max(t.p_px[1].y, t.p_px[2].y));
    return !(sx1 <= tx0 || tx1 <= sx0 || sy1 <= ty0 || ty1 <= sy0);
}

/// Whether v is on the outer side of an edge from a along e, or one of the edge's ends.
EDGEWISE_FN bool beyondOrOn(dvec2 a, dvec2 e, dvec2 v) {
    dvec2 d = v - a;
    double px = e.x * d.y, py = e.y * d.x;
    if (v == a || d == e) return true;
    return px - py < EDGEWISE_REAL(-3.3306690738754696e-16) * (abs(px) + abs(py));
}

/// Whether some edge of s has t on its outer side, where t may touch the edge's ends: surely.
EDGEWISE_FN bool separates(EDGEWISE_IN(ScreenTriangle) s, EDGEWISE_IN(ScreenTriangle) t) {
    for (int k = 0; k < 3; ++k) {
        dvec2 a = s.p_px[k], e = s.p_px[k == 2 ? 0 : k + 1] - a;
        if (beyondOrOn(a, e, t.p_px[0]) && beyondOrOn(a, e, t.p_px[1]) && beyondOrOn(a, e, t.p_px[2])) return true;
    }
    return false;
}

/// cross(e, p - a) for each edge of t, the smallest, with the bound of its rounding.
struct InnerDistance {
    double value;
    double error;
};
EDGEWISE_FN InnerDistance innerDistance(EDGEWISE_IN(ScreenTriangle) t, dvec2 p) {
    InnerDistance smallest;
    for (int k = 0; k < 3; ++k) {
        dvec2 a = t.p_px[k], e = t.p_px[k == 2 ? 0 : k + 1] - a, d = p - a;
        double x = e.x * d.y, y = e.y * d.x;
        if (k == 0 || x - y < smallest.value) {
            smallest.value = x - y;
            smallest.error = EDGEWISE_REAL(3.3306690738754696e-16) * (abs(x) + abs(y));
        }
    }
    return smallest;
}

/// Whether the segment a -> b may meet the cell.
EDGEWISE_FN bool mayMeet(dvec2 a, dvec2 b, EDGEWISE_IN(Cell) cell) {
    if (max(a.x, b.x) <= cell.min.x || min(a.x, b.x) > cell.max.x) return false;
    if (max(a.y, b.y) <= cell.min.y || min(a.y, b.y) > cell.max.y) return false;
    dvec2 e = b - a, c = EDGEWISE_REAL(0.5) * (cell.min + cell.max) - a, h = EDGEWISE_REAL(0.5) * (cell.max - cell.min);
    double middle = e.x * c.y - e.y * c.x;
    double reach = abs(e.x) * h.y + abs(e.y) * h.x;
    double slack = (abs(e.x) + abs(e.y)) * EDGEWISE_REAL(1.1641532182693481e-10) +
                   EDGEWISE_REAL(4.440892098500626e-16) * (abs(e.x * c.y) + abs(e.y * c.x) + reach);
    return abs(middle) <= reach + slack;
}
