// Where a triangle is shaded: its point nearest to a sample on the screen, and perspective-correct barycentrics there.

#define EDGEWISE_FARTHEST_PX2 EDGEWISE_REAL(1e300)  // beyond the guard band

/// Twice the area of a, b, s in px^2; 0 or more where s lies on the inner side of the edge.
EDGEWISE_EXACT_FN real sideOf(dvec2 a, dvec2 b, dvec2 s) { return cross2(b - a, s - a); }

/// From s to the nearest point of the segment a, b; the differences of grid points are exact.
EDGEWISE_EXACT_FN dvec2 offsetToSegment(dvec2 a, dvec2 b, dvec2 s) {
    dvec2 along = b - a;
    real t = -inner(a - s, along) / inner(along, along);
    return either(t <= 0.0, a - s, either(t >= 1.0, b - s, (a - s) + along * t));
}

/// The ray through p + delta, px, the principal point being whole + fraction + offset: screen_map.h says why apart.
EDGEWISE_EXACT_FN dvec2 imagePlanePoint(dvec2 p, dvec2 delta, dvec2 offset, dvec2 whole, dvec2 fraction, double scale_px) {
    dvec2 from_centre = (((p - offset) - whole) - fraction) + delta;
    return dvec2(from_centre.x / scale_px, -from_centre.y / scale_px);
}

/// A place on a triangle: perspective-correct barycentrics and how they change along the screen's axes.
struct SurfacePoint {
    dvec3 barycentric;
    dvec3 d_dx;  // per pixel
    dvec3 d_dy;
    dvec3 p_eye;
};

/// Of values at the three corners.
EDGEWISE_EXACT_FN dvec2 mix3(dvec2 a, dvec2 b, dvec2 c, dvec3 w) { return a * w.x + b * w.y + c * w.z; }
EDGEWISE_EXACT_FN dvec3 mix3(dvec3 a, dvec3 b, dvec3 c, dvec3 w) { return a * w.x + b * w.y + c * w.z; }
EDGEWISE_EXACT_FN dvec4 mix3(dvec4 a, dvec4 b, dvec4 c, dvec3 w) { return a * w.x + b * w.y + c * w.z; }

/// Inside [0, 1] and summing to 1: nothing is extrapolated, not even from a triangle seen almost edge-on.
EDGEWISE_EXACT_FN dvec3 clampToTriangle(dvec3 w) {
    dvec3 bounded = dvec3(clamped(w.x, 0.0, 1.0), clamped(w.y, 0.0, 1.0), clamped(w.z, 0.0, 1.0));
    real sum = bounded.x + bounded.y + bounded.z;
    return either(sum > 0.0, bounded / sum, dvec3(EDGEWISE_REAL(1.0) / EDGEWISE_REAL(3.0)));
}

/// Of weights that change by d, as a share of their sum.
EDGEWISE_EXACT_FN dvec3 shareSlope(dvec3 weight, real sum, dvec3 d, double scale_px) {
    return (d - (weight / sum) * (d.x + d.y + d.z)) / (sum * scale_px);
}

/// Barycentrics of the plane's point on the pixel's ray, the corners being in eye space. A corner a is moved along the
/// ray r = (u, v, -1) onto z = 0, a' = a + a.z (u, v): det(r, b, c) does not change by that, so the weight of a is
/// cross(b', c'), whether or not the corners lie behind the eye. Orthographic: a' = a - (u, v). The weights are affine
/// in (u, v).
EDGEWISE_EXACT_FN SurfacePoint surfacePointAt(dvec3 a, dvec3 b, dvec3 c, dvec2 uv, bool perspective, double scale_px) {
    dvec3 slope = perspective ? dvec3(a.z, b.z, c.z) : dvec3(-1.0);  // d a' / d(u, v), times the identity
    dvec2 ma = dvec2(a) + slope.x * uv;
    dvec2 mb = dvec2(b) + slope.y * uv;
    dvec2 mc = dvec2(c) + slope.z * uv;
    dvec3 weight = dvec3(cross2(mb, mc), cross2(mc, ma), cross2(ma, mb));
    dvec3 d_du = dvec3(slope.y * mc.y - mb.y * slope.z, slope.z * ma.y - mc.y * slope.x, slope.x * mb.y - ma.y * slope.y);
    dvec3 d_dv = dvec3(mb.x * slope.z - slope.y * mc.x, mc.x * slope.x - slope.z * ma.x, ma.x * slope.y - slope.x * mb.x);
    real sum = weight.x + weight.y + weight.z;
    mask seen = sum != 0.0;
    SurfacePoint at;
    at.barycentric = either(seen, clampToTriangle(weight / sum), dvec3(EDGEWISE_REAL(1.0) / EDGEWISE_REAL(3.0)));
    at.d_dx = either(seen, shareSlope(weight, sum, d_du, scale_px), dvec3(0.0));
    at.d_dy = either(seen, -shareSlope(weight, sum, d_dv, scale_px), dvec3(0.0));
    at.p_eye = mix3(a, b, c, at.barycentric);
    return at;
}

/// Unit, from the point to where it is seen from.
EDGEWISE_EXACT_FN dvec3 viewFrom(dvec3 p_eye, bool everywhere_the_same) {
    dvec3 ahead = dvec3(splat(0.0), splat(0.0), splat(1.0));
    if (everywhere_the_same) return ahead;
    real distance_ = lengthOf(p_eye);
    return either(distance_ == 0.0, ahead, -p_eye / distance_);
}
