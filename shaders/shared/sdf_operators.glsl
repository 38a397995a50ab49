// What combines and changes signed distances (a, b) and positions (p): the same rules as in sdf_shapes.glsl.

EDGEWISE_FN real unite(real a, real b) {
    return min(a, b);
}
EDGEWISE_FN real intersect(real a, real b) {
    return max(a, b);
}
EDGEWISE_FN real subtract(real a, real b) {
    return max(a, -b);
}

/// The quadratic blend of compact support: min(a, b) to the last bit where |a - b| >= k; its derivatives by a and b are
/// between 0 and 1 and sum to 1.
EDGEWISE_FN real smoothUnite(real a, real b, real k) {
    real h = max(k - abs(a - b), real(0.0));
    return min(a, b) - h * h * (real(0.25) / k);
}
EDGEWISE_FN real smoothIntersect(real a, real b, real k) {
    real h = max(k - abs(a - b), real(0.0));
    return max(a, b) + h * h * (real(0.25) / k);
}
EDGEWISE_FN real smoothSubtract(real a, real b, real k) {
    return smoothIntersect(a, -b, k);
}

EDGEWISE_FN real complementOf(real a) {
    return -a;
}
/// Grown by `distance` everywhere.
EDGEWISE_FN real offsetBy(real a, real distance) {
    return a - distance;
}
/// A sheet around the surface.
EDGEWISE_FN real shellOf(real a, real half_width) {
    return abs(a) - half_width;
}
EDGEWISE_FN real scaleValue(real a, real factor) {
    return a * factor;
}

// Of values at positions: `p` is where the node is asked, before its own change of position.

/// The product of three sines has no slope above the largest frequency: its square is linear in each sine's square, so
/// its maximum is where each is 0 or 1.
EDGEWISE_FN real displaceBy(real a, vec3 p, real amplitude, vec3 frequency, vec3 phase) {
    vec3 q = p * frequency + phase;
    return a + amplitude * (sine(q.x) * sine(q.y) * sine(q.z));
}
/// What lies within `radius` of the y axis is no nearer than that cylinder.
EDGEWISE_FN real withinRadius(real a, vec3 p, real radius) {
    return max(a, planarLength(p.x, p.z) - radius);
}
/// The next cell's copy is no nearer than the wall between them plus `margin`, its distance from the wall. Cells without a
/// neighbour, and axes without repetition, have no wall: spacing 0, or the last of +-count cells.
EDGEWISE_FN real wallOf(real x, real spacing, real count) {
    real cell = clamp(floor(x / spacing + real(0.5)), -count, count);
    real within = x - spacing * cell;
    real up = choose(less(cell, count), real(0.5) * spacing - within, real(1e30));
    real down = choose(less(-count, cell), real(0.5) * spacing + within, real(1e30));
    return min(up, down);
}
EDGEWISE_FN real withinWalls(real a, vec3 p, vec3 spacing, vec3 count, vec3 margin) {
    real x = wallOf(p.x, spacing.x, count.x) + margin.x;
    real y = wallOf(p.y, spacing.y, count.y) + margin.y;
    real z = wallOf(p.z, spacing.z, count.z) + margin.z;
    return min(a, min(x, min(y, z)));
}

// Of positions: the child is asked where these lead.

EDGEWISE_FN vec3 translateBy(vec3 p, vec3 by) {
    return p - by;
}
/// By the rows of the inverse rotation.
EDGEWISE_FN vec3 rotateBy(vec3 p, vec3 row_x, vec3 row_y, vec3 row_z) {
    return vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
}
/// Component by component.
EDGEWISE_FN vec3 stretchBy(vec3 p, vec3 inverse_factors) {
    return p * inverse_factors;
}
/// |x| where fold.x is 1, x where it is 0.
EDGEWISE_FN vec3 foldAxes(vec3 p, vec3 fold) {
    vec3 q = abs(p);
    return vec3(choose(less(real(0.5), fold.x), q.x, p.x), choose(less(real(0.5), fold.y), q.y, p.y),
                choose(less(real(0.5), fold.z), q.z, p.z));
}
EDGEWISE_FN real repeatAxis(real x, real spacing, real count) {
    return x - spacing * clamp(floor(x / spacing + real(0.5)), -count, count);
}
/// Copies `spacing` apart, count to either side; count 0 leaves an axis alone.
EDGEWISE_FN vec3 repeatBy(vec3 p, vec3 spacing, vec3 count) {
    return vec3(repeatAxis(p.x, spacing.x, count.x), repeatAxis(p.y, spacing.y, count.y),
                repeatAxis(p.z, spacing.z, count.z));
}
/// Cut in the middle and pulled apart: straight pieces of 2 half_size between the halves.
EDGEWISE_FN vec3 elongateBy(vec3 p, vec3 half_size) {
    return p - clamp(p, -half_size, half_size);
}
/// Turns around the y axis by rate * y, after moving radially to within `radius`: beyond it nothing is twisted further.
EDGEWISE_FN vec3 twistBy(vec3 p, real rate, real radius) {
    real inward = min(real(1.0), radius / max(planarLength(p.x, p.z), radius));
    real s = sine(rate * p.y);
    real c = cosine(rate * p.y);
    return vec3((c * p.x + s * p.z) * inward, p.y, (c * p.z - s * p.x) * inward);
}
