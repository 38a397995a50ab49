// A convex polygon that holds the part of a cell where two triangles lie over each other, from the cell's origin.
// Places are cut from edges a little too far out, never too far in: by as much of the edge as roundings of
// distances may be.

struct CommonPart {
    dvec2 at[10];  ///< three edges, cut by seven lines
    int count;
    bool lost;     ///< there were more: roundings made the polygon cross a line more than twice
    double reach;  ///< no coordinate is larger
};

EDGEWISE_FN void pushPlace(EDGEWISE_INOUT(CommonPart) part, dvec2 place) {
    if (part.count < 10)
        part.at[part.count++] = place;
    else
        part.lost = true;
}

/// What a place may be off: seven cuts in a row, each with five roundings of the largest coordinate.
EDGEWISE_FN double placeError(EDGEWISE_IN(CommonPart) part) {
    return EDGEWISE_REAL(4.440892098500626e-15) * part.reach;
}

/// A place's distance to a line, times the length of `inward`, and what it may be off.
struct CutDistance {
    double value;
    double error;
};

/// Three roundings of either term: of the difference, the product and the sum.
EDGEWISE_FN CutDistance cutDistance(dvec2 place, double place_error, dvec2 inward, dvec2 on_line) {
    double x = inward.x * (place.x - on_line.x), y = inward.y * (place.y - on_line.y);
    double rounding = EDGEWISE_REAL(4.440892098500626e-16) * (abs(x) + abs(y));
    return CutDistance(EDGEWISE_INIT x + y,
                       rounding + (abs(inward.x) + abs(inward.y)) * place_error EDGEWISE_END);
}

/// Where the edge from `a`, which is in, to `b`, which is not, leaves.
EDGEWISE_FN dvec2 cutPlace(dvec2 a, dvec2 b, CutDistance in_a, CutDistance out_b) {
    double slack = in_a.error + out_b.error, fall = in_a.value - out_b.value;
    if (!(fall > EDGEWISE_REAL(4.0) * slack)) return b;
    double share = (max(in_a.value, EDGEWISE_REAL(0.0)) + slack) / (fall - slack);
    return share < EDGEWISE_REAL(1.0) ? a + share * (b - a) : b;
}

/// Keeps where dot(inward, p - on_line) may be at least 0.
EDGEWISE_FN void cutCommonPart(EDGEWISE_INOUT(CommonPart) part, dvec2 inward, dvec2 on_line) {
    CommonPart kept = part;
    kept.count = 0;
    double place_error = placeError(part);
    CutDistance first = cutDistance(part.at[0], place_error, inward, on_line), here = first;
    for (int i = 0; i < part.count; ++i) {
        int j = i + 1 == part.count ? 0 : i + 1;
        CutDistance next = first;
        if (j > 0) next = cutDistance(part.at[j], place_error, inward, on_line);
        bool is_in = here.value >= -here.error, next_in = next.value >= -next.error;
        if (is_in) pushPlace(kept, part.at[i]);
        if (is_in && !next_in) pushPlace(kept, cutPlace(part.at[i], part.at[j], here, next));
        if (!is_in && next_in) pushPlace(kept, cutPlace(part.at[j], part.at[i], next, here));
        here = next;
    }
    part = kept;
}

/// Of s and t in the cell from lo to hi, which are counted from the origin.
EDGEWISE_FN CommonPart commonPart(EDGEWISE_IN(ScreenTriangle) s, EDGEWISE_IN(ScreenTriangle) t, dvec2 origin, dvec2 lo,
                                  dvec2 hi) {
    CommonPart part;
    part.count = 0;
    part.lost = false;
    part.reach = EDGEWISE_REAL(0.0);
    for (uint k = 0u; k < 3u; ++k) {
        dvec2 v = s.p_px[k] - origin;
        pushPlace(part, v);
        part.reach = max(part.reach, max(abs(v.x), abs(v.y)));
    }
    double one = EDGEWISE_REAL(1.0), none = EDGEWISE_REAL(0.0);
    cutCommonPart(part, dvec2(one, none), lo);
    cutCommonPart(part, dvec2(-one, none), hi);
    cutCommonPart(part, dvec2(none, one), lo);
    cutCommonPart(part, dvec2(none, -one), hi);
    for (uint k = 0u; k < 3u && part.count > 0; ++k) {
        dvec2 a = t.p_px[k] - origin, e = (t.p_px[k == 2u ? 0u : k + 1u] - origin) - a;
        cutCommonPart(part, dvec2(-e.y, e.x), a);
    }
    return part;
}

/// A sign of p - q at a place, from the origin: bit 0 where it may be positive, bit 1 where it may be negative.
/// `place_error`: what the place's own is worth in depth. Roundings beyond the leaf's own bound: the place may lie
/// far outside the cell.
EDGEWISE_FN int signsAt(dvec2 v, EDGEWISE_IN(LocalPlane) p, EDGEWISE_IN(LocalPlane) q, double place_error) {
    double d = depthAt(p, v.x, v.y) - depthAt(q, v.x, v.y);
    double far = (abs(p.a) + abs(q.a)) * abs(v.x) + (abs(p.b) + abs(q.b)) * abs(v.y);
    double error = p.error + q.error + EDGEWISE_REAL(8.881784197001252e-16) * far + place_error;
    return (d > -error ? 1 : 0) | (d < error ? 2 : 0);
}

/// The same over the vertices of t.
EDGEWISE_FN int signsAtVertices(EDGEWISE_IN(ScreenTriangle) t, EDGEWISE_IN(LocalPlane) p, EDGEWISE_IN(LocalPlane) q,
                                dvec2 origin) {
    int signs = 0;
    for (uint k = 0u; k < 3u; ++k) signs |= signsAt(t.p_px[k] - origin, p, q, EDGEWISE_REAL(0.0));
    return signs;
}

/// The same over all of the common part.
EDGEWISE_FN int signsOver(EDGEWISE_IN(CommonPart) part, EDGEWISE_IN(LocalPlane) p, EDGEWISE_IN(LocalPlane) q) {
    double slopes = abs(p.a) + abs(q.a) + abs(p.b) + abs(q.b);
    int signs = part.lost ? 3 : 0;
    for (int i = 0; i < part.count; ++i) signs |= signsAt(part.at[i], p, q, slopes * placeError(part));
    return signs;
}
