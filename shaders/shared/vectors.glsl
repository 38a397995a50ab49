// Vectors of doubles, with one order of operations on every device: that of glm.

EDGEWISE_EXACT_FN double inner(dvec2 a, dvec2 b) { return a.x * b.x + a.y * b.y; }
EDGEWISE_EXACT_FN double inner(dvec3 a, dvec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
EDGEWISE_EXACT_FN double cross2(dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; }
EDGEWISE_EXACT_FN dvec3 outer(dvec3 a, dvec3 b) {
    return dvec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
}
EDGEWISE_EXACT_FN double lengthOf(dvec2 a) { return sqrt(inner(a, a)); }
EDGEWISE_EXACT_FN double lengthOf(dvec3 a) { return sqrt(inner(a, a)); }
EDGEWISE_FN double clamped(double x, double low, double high) { return smaller(larger(x, low), high); }

/// Of length 1, or 0 where v is 0. Neither overflows nor underflows.
EDGEWISE_EXACT_FN dvec3 unitOrZero(dvec3 v) {
    double size = larger(larger(absolute(v.x), absolute(v.y)), absolute(v.z));
    if (size == 0.0) return dvec3(0.0);
    dvec3 scaled = v / size;
    return scaled / lengthOf(scaled);
}
EDGEWISE_FN bool isZero(dvec3 v) { return v.x == 0.0 && v.y == 0.0 && v.z == 0.0; }
