// Normal maps: tangents and bumps. Eye space; pipeline/shade.h says which way is which.

EDGEWISE_EXACT_FN dvec3 orthogonalTo(dvec3 normal, dvec3 t) { return unitOrZero(t - normal * inner(normal, t)); }

/// How the position changes with u on a triangle, times its positive area in (u, v); 0 where u and v do not span it.
EDGEWISE_EXACT_FN dvec3 alongU(dvec3 p0, dvec3 p1, dvec3 p2, dvec2 uv0, dvec2 uv1, dvec2 uv2) {
    dvec2 a = uv1 - uv0;
    dvec2 b = uv2 - uv0;
    double turn = cross2(a, b);
    double side = turn < 0.0 ? -1.0 : (turn > 0.0 ? 1.0 : 0.0);
    return side * ((p1 - p0) * b.y - (p2 - p0) * a.y);
}
EDGEWISE_EXACT_FN dvec3 alongV(dvec3 p0, dvec3 p1, dvec3 p2, dvec2 uv0, dvec2 uv1, dvec2 uv2) {
    dvec2 a = uv1 - uv0;
    dvec2 b = uv2 - uv0;
    double turn = cross2(a, b);
    double side = turn < 0.0 ? -1.0 : (turn > 0.0 ? 1.0 : 0.0);
    return side * ((p2 - p0) * a.x - (p1 - p0) * b.x);
}

/// y of the map runs against v.
EDGEWISE_EXACT_FN double bitangentSign(dvec3 normal, dvec3 tangent, dvec3 along_v) {
    return inner(outer(normal, tangent), along_v) > 0.0 ? -1.0 : 1.0;
}

/// The normal under the map's texel in [0, 1]^3; 0 where the map takes it away.
EDGEWISE_EXACT_FN dvec3 bumpedNormal(dvec3 normal, dvec3 tangent, double sign_, dvec3 texel, double scale) {
    dvec3 map = (2.0 * texel - 1.0) * dvec3(scale, scale, 1.0);
    dvec3 bitangent = outer(normal, tangent) * sign_;
    return unitOrZero(tangent * map.x + bitangent * map.y + normal * map.z);
}
