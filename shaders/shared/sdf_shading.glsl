// How surfaces of SDF scenes scatter, mirror and refract light: pipeline/lighting.h's units (a colour of 1 is 1 cd/m^2,
// lights are lux and candela). Directions are unit vectors; normals `n` stand on the ray's side of the surface.
//
// C++ compiles this text as double (sdf/shading_text.h), GLSL as float. It needs powerOf(x, y) and exponential(x).

const real kPi = real(3.14159265358979323846);
const real kInversePi = real(0.31830988618379067154);

// Patterns in the frame of the shape that wins: 1 where the second colour is seen, else 0.

EDGEWISE_FN real odd(real whole) {
    return whole - real(2.0) * floor(real(0.5) * whole);
}
/// Cubes `size` wide, with a corner at the origin.
EDGEWISE_FN real checkerAt(vec3 p_local, real size) {
    return odd(floor(p_local.x / size) + floor(p_local.y / size) + floor(p_local.z / size));
}
/// A stripe and its gap along `axis` (unit) are `size` wide together.
EDGEWISE_FN real stripesAt(vec3 p_local, vec3 axis, real size) {
    return odd(floor(real(2.0) * dot(p_local, axis) / size));
}

// What arrives of light leaves towards the view.

EDGEWISE_FN real cosineTowards(vec3 n, vec3 towards) {
    return max(dot(n, towards), real(0.0));
}
/// Lux of a point light of 1 candela at this distance, facing it; at the light itself none.
EDGEWISE_FN real pointFalloff(real distance_) {
    return distance_ > real(0.0) ? real(1.0) / (distance_ * distance_) : real(0.0);
}
EDGEWISE_FN vec3 lambertShare(vec3 color) {
    return color * kInversePi;
}
/// Lambert, and Blinn's highlight with the exponent's usual norm, (shininess + 8) / (8 pi): within 10 % of the energy
/// of the lobe about the normal.
EDGEWISE_FN vec3 blinnPhongShare(vec3 color, vec3 specular, real shininess, vec3 n, vec3 view, vec3 towards) {
    vec3 sum = view + towards;
    real size = length(sum);
    real cosine_ = size > real(0.0) ? max(dot(n, sum) / size, real(0.0)) : real(0.0);
    real norm = (shininess + real(8.0)) * real(0.125) * kInversePi;
    return color * kInversePi + specular * (norm * powerOf(cosine_, shininess));
}

// Mirrors and glass.

/// Schlick 1994, of a mirror that is known by its share at normal incidence alone; 0 stays 0.
EDGEWISE_FN real mirrorShare(real at_normal, real cosine_) {
    real dark = real(1.0) - clamp(cosine_, real(0.0), real(1.0));
    real dark2 = dark * dark;
    return at_normal > real(0.0) ? at_normal + (real(1.0) - at_normal) * dark2 * dark2 * dark : real(0.0);
}
/// Fresnel's equations, of unpolarised light on a dielectric: `eta` is the index ahead over the index behind,
/// `cosine_` between the ray and the normal, >= 0. 1 where all is reflected.
///     s: (cos i - eta cos t) / (cos i + eta cos t),  p: (eta cos i - cos t) / (eta cos i + cos t)
EDGEWISE_FN real fresnelShare(real cosine_, real eta) {
    real cos_i = min(cosine_, real(1.0));
    real cos2_t = real(1.0) - (real(1.0) - cos_i * cos_i) / (eta * eta);
    if (cos2_t <= real(0.0)) return real(1.0);
    real cos_t = sqrt(cos2_t);
    real s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    real p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    return real(0.5) * (s * s + p * p);
}
/// Shares of what a ray brings from: scattered light (x), the mirror's direction (y), through the surface (z). They sum
/// to 1. A coat that mirrors `mirror` lies over a mixture of `transmittance` glass, of which `fresnel` is reflected, and
/// what scatters.
EDGEWISE_FN vec3 surfaceShares(real mirror, real transmittance, real fresnel) {
    real passes = real(1.0) - mirror;
    real glass = passes * transmittance;
    return vec3(passes * (real(1.0) - transmittance), mirror + glass * fresnel, glass * (real(1.0) - fresnel));
}
EDGEWISE_FN vec3 mirrored(vec3 direction, vec3 n) {
    return direction - n * (real(2.0) * dot(direction, n));
}
/// Snell's law, with `eta` as above; 0 where all is reflected.
EDGEWISE_FN vec3 refracted(vec3 direction, vec3 n, real eta) {
    real cos_i = -dot(direction, n);
    real cos2_t = real(1.0) - (real(1.0) - cos_i * cos_i) / (eta * eta);
    if (cos2_t <= real(0.0)) return vec3(real(0.0));
    return direction / eta + n * (cos_i / eta - sqrt(cos2_t));
}
/// Beer's law.
EDGEWISE_FN vec3 absorbed(vec3 absorption, real distance_) {
    return vec3(exponential(-absorption.x * distance_), exponential(-absorption.y * distance_),
                exponential(-absorption.z * distance_));
}

/// How far secondary rays begin from the hit, along the normal on their side (Keinert et al. 2014, section 3.3).
EDGEWISE_FN real dynamicOffset(real least, real value) {
    return real(2.0) * max(least, abs(value));
}
