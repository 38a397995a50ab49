// Vectors of reals, with one order of operations on every device: that of glm.

EDGEWISE_EXACT_FN real inner(dvec2 a, dvec2 b) { return a.x * b.x + a.y * b.y; }
EDGEWISE_EXACT_FN real inner(dvec3 a, dvec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
EDGEWISE_EXACT_FN real cross2(dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; }
EDGEWISE_EXACT_FN dvec3 outer(dvec3 a, dvec3 b) {
    return dvec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
}
EDGEWISE_EXACT_FN real lengthOf(dvec2 a) { return sqrt(inner(a, a)); }
EDGEWISE_EXACT_FN real lengthOf(dvec3 a) { return sqrt(inner(a, a)); }
EDGEWISE_FN real clamped(real x, double low, double high) { return smaller(larger(x, splat(low)), splat(high)); }

/// `a` where `first` holds, else `b`.
EDGEWISE_FN dvec2 either(mask first, dvec2 a, dvec2 b) { return dvec2(first ? a.x : b.x, first ? a.y : b.y); }
EDGEWISE_FN dvec3 either(mask first, dvec3 a, dvec3 b) {
    return dvec3(first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z);
}

/// Of length 1, or 0 where v is 0. Neither overflows nor underflows.
EDGEWISE_EXACT_FN dvec3 unitOrZero(dvec3 v) {
    real size = larger(larger(absolute(v.x), absolute(v.y)), absolute(v.z));
    dvec3 scaled = v / size;
    return either(size == 0.0, dvec3(0.0), scaled / lengthOf(scaled));
}
EDGEWISE_FN mask isZero(dvec3 v) { return EDGEWISE_BOTH(EDGEWISE_BOTH(v.x == 0.0, v.y == 0.0), v.z == 0.0); }
