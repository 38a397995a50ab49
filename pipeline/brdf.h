// The metallic-roughness BRDF of glTF 2.0, Appendix B.
#pragma once

#include <glm/vec3.hpp>

namespace edgewise {

/// A material where it is lit.
struct Reflectance {
    glm::dvec3 base{1.0};
    double metallic = 0.0, roughness = 1.0;  ///< [0, 1]
};

/// A punctual light has no extent, so a mirror would show a point of infinite radiance: roughness counts as
/// at least this. With alpha = 2^-8 a highlight falls to half at 2 * 0.64 alpha = 0.29 degrees from its
/// centre, about the sun's radius.
inline constexpr double kLeastRoughness = 1.0 / 16.0;

/// The share of the light from `l` that leaves towards `v`, 1/sr, without the cosine; all three are unit
/// vectors, n . l > 0. With alpha = roughness^2, H the bisector of V and L, c = |V.H|, f = (1 - c)^5:
///     D = alpha^2 [N.H > 0] / (pi ((N.H)^2 (alpha^2 - 1) + 1)^2)                  Trowbridge-Reitz (GGX)
///     V = 1 / ((|N.L| + s(N.L)) (|N.V| + s(N.V))),  s(x) = sqrt(alpha^2 + (1 - alpha^2) x^2)       Smith
///     dielectric = mix(base / pi, D V, 0.04 + 0.96 f),   metal = D V (base + (1 - base) f)       Schlick
///     BRDF = mix(dielectric, metal, metallic)
/// V is the separable form that the Appendix prints; viewers that take the height-correlated one differ by a
/// few per cent on rough surfaces at grazing angles. Reciprocal. Each lobe sends back at most what arrives;
/// a smooth white dielectric seen at a grazing angle may send back more, because the Appendix takes the
/// reflected light from the diffuse lobe by V.H and not by N.V.
glm::dvec3 brdf(const Reflectance& surface, const glm::dvec3& n, const glm::dvec3& v, const glm::dvec3& l);

}  // namespace edgewise
