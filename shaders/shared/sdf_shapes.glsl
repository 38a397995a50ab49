// Signed distances of shapes about the origin: negative inside, never more than the Euclidean distance, and never
// changing faster than position does (Lipschitz bound 1). Exact but where said otherwise.
//
// C++ compiles this text for every kind of number that sdf/ evaluates with (double, float, lanes, gradients, intervals,
// running errors), so there are no branches: less(a, b) and choose(condition, a, b) stand for them.
// vec2s are two reals, so that all kinds of numbers need one vector.

EDGEWISE_FN real planarLength(real x, real y) {
    return sqrt(square(x) + square(y));
}

EDGEWISE_FN real sphereAt(vec3 p, real radius) {
    return length(p) - radius;
}

EDGEWISE_FN real boxAt(vec3 p, vec3 half_size) {
    vec3 q = abs(p) - half_size;
    return length(max(q, vec3(real(0.0)))) + min(max(q.x, max(q.y, q.z)), real(0.0));
}

/// The distance of q from a beam along x: the corner where y and z are beyond their faces.
EDGEWISE_FN real beamAt(real along, real y, real z) {
    return length(max(vec3(along, y, z), vec3(real(0.0)))) + min(max(along, max(y, z)), real(0.0));
}

/// The twelve edges of a box as beams `thickness` wide, inside its faces.
EDGEWISE_FN real boxFrameAt(vec3 p, vec3 half_size, real thickness) {
    real half_beam = real(0.5) * thickness;
    vec3 outer = abs(p) - half_size;
    vec3 beam = abs(outer + vec3(half_beam)) - vec3(half_beam);
    return min(beamAt(outer.x, beam.y, beam.z),
               min(beamAt(outer.y, beam.x, beam.z), beamAt(outer.z, beam.x, beam.y)));
}

/// Around the y axis: `major` to the middle of the tube, `minor` its radius.
EDGEWISE_FN real torusAt(vec3 p, real major, real minor) {
    return planarLength(planarLength(p.x, p.z) - major, p.y) - minor;
}

EDGEWISE_FN real capsuleAt(vec3 p, vec3 from, vec3 along, real inverse_length2, real radius) {
    vec3 q = p - from;
    real t = clamp(dot(q, along) * inverse_length2, real(0.0), real(1.0));
    return length(q - along * t) - radius;
}

/// Around the y axis.
EDGEWISE_FN real cylinderAt(vec3 p, real radius, real half_height) {
    real side = planarLength(p.x, p.z) - radius;
    real cap = abs(p.y) - half_height;
    return planarLength(max(side, real(0.0)), max(cap, real(0.0))) + min(max(side, cap), real(0.0));
}

/// A frustum around the y axis, with these radii at -half_height and +half_height: in the plane of (rho, y) the nearer of
/// the side, a segment, and the cap on p's side; inside where p is below both.
EDGEWISE_FN real coneAt(vec3 p, real bottom, real top, real half_height) {
    real rho = planarLength(p.x, p.z);
    real cap_radius = choose(less(p.y, real(0.0)), bottom, top);
    real over_cap = abs(p.y) - half_height;
    real cap2 = square(rho - min(rho, cap_radius)) + square(over_cap);
    real side_x = top - bottom;
    real side_y = real(2.0) * half_height;
    real x = rho - bottom;
    real y = p.y + half_height;
    real t = clamp((x * side_x + y * side_y) / (square(side_x) + square(side_y)), real(0.0), real(1.0));
    real side2 = square(x - side_x * t) + square(y - side_y * t);
    real nearest = sqrt(min(cap2, side2));
    real outside = max(over_cap, x * side_y - y * side_x);
    return choose(less(outside, real(0.0)), -nearest, nearest);
}

EDGEWISE_FN real planeAt(vec3 p, vec3 normal, real offset) {
    return dot(p, normal) - offset;
}

/// A bound: (|p / radii| - 1) times the smallest radius.
EDGEWISE_FN real ellipsoidAt(vec3 p, vec3 inverse_radii, real smallest) {
    return (length(p * inverse_radii) - real(1.0)) * smallest;
}

/// A bound beyond the edges: the largest distance to a face's plane. So are the next three.
EDGEWISE_FN real octahedronAt(vec3 p, real radius) {
    vec3 q = abs(p);
    return (q.x + q.y + q.z - radius) * real(0.57735026918962576451);
}

/// Generalized distance functions (Akleman and Chen 1999): faces at `inradius` along the icosahedron's vertices.
EDGEWISE_FN real dodecahedronAt(vec3 p, real inradius) {
    vec3 q = abs(p);
    real major = real(0.85065080835203993218);
    real minor = real(0.52573111211913360603);
    return max(q.x * minor + q.y * major, max(q.y * minor + q.z * major, q.z * minor + q.x * major)) - inradius;
}

/// Faces at `inradius` along the dodecahedron's vertices: (1, 1, 1) and (0, 1/phi, phi) in turn, over sqrt(3).
EDGEWISE_FN real icosahedronAt(vec3 p, real inradius) {
    vec3 q = abs(p);
    real small = real(0.35682208977308993194);
    real large = real(0.93417235896271569645);
    real cube = (q.x + q.y + q.z) * real(0.57735026918962576451);
    real rest = max(q.y * small + q.z * large, max(q.z * small + q.x * large, q.x * small + q.y * large));
    return max(cube, rest) - inradius;
}

/// Around the y axis, with faces at `inradius` along z and 60 degrees from it.
EDGEWISE_FN real hexPrismAt(vec3 p, real inradius, real half_height) {
    vec3 q = abs(p);
    real side = max(q.z, q.x * real(0.86602540378443864676) + q.z * real(0.5)) - inradius;
    return max(side, q.y - half_height);
}

/// The sheet |g| <= half_width of g = (sin x cos y + sin y cos z + sin z cos x) / (sqrt(3) frequency) at frequency * p: by
/// Cauchy's inequality each derivative of the bracket is at most sqrt(cos^2 + sin^2) of two other coordinates, and the
/// squares of the three sum to 3.
EDGEWISE_FN real gyroidAt(vec3 p, real frequency, real half_width) {
    vec3 q = p * frequency;
    real bracket = sine(q.x) * cosine(q.y) + sine(q.y) * cosine(q.z) + sine(q.z) * cosine(q.x);
    return abs(bracket) / (real(1.73205080756887729353) * frequency) - half_width;
}

/// The square tunnels of one level of Menger's sponge, through every cell of a lattice whose cell is `cell` wide and has a
/// corner at `corner`: the middle third along each axis. A bound: the distance within the plane across the tunnel, by
/// its larger coordinate.
EDGEWISE_FN real tunnelsAt(vec3 p, vec3 corner, real cell) {
    vec3 q = (p - corner) / cell;
    real x = abs(q.x - floor(q.x) - real(0.5));
    real y = abs(q.y - floor(q.y) - real(0.5));
    real z = abs(q.z - floor(q.z) - real(0.5));
    real nearest = min(max(x, y), min(max(y, z), max(z, x)));
    return (nearest - real(0.16666666666666666667)) * cell;
}
