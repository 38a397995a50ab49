#include "pipeline/brdf.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace edgewise {
namespace {

constexpr double kDielectricF0 = 0.04;  // an index of refraction of 1.5

double smith(double cosine, double alpha2) {
    return cosine + std::sqrt(alpha2 + (1.0 - alpha2) * cosine * cosine);
}

/// D V, 1/sr. The denominator's root is (alpha N.H)^2 + |N x H|^2: nothing cancels in a sharp highlight.
double microfacets(const glm::dvec3& n, const glm::dvec3& h, double nl, double nv, double roughness) {
    const double nh = glm::dot(n, h), alpha = roughness * roughness, alpha2 = alpha * alpha;
    if (!(nh > 0.0)) return 0.0;
    const glm::dvec3 across = glm::cross(n, h);
    const double root = alpha2 * nh * nh + glm::dot(across, across);
    return alpha2 / (M_PI * root * root * smith(nl, alpha2) * smith(nv, alpha2));
}

}  // namespace

glm::dvec3 brdf(const Reflectance& surface, const glm::dvec3& n, const glm::dvec3& v, const glm::dvec3& l) {
    const glm::dvec3 sum = v + l;
    const double size = std::sqrt(glm::dot(sum, sum));
    if (size == 0.0) return (1.0 - surface.metallic) * surface.base * (1.0 / M_PI);  // light from behind
    const glm::dvec3 h = sum / size;
    const double dark = std::max(0.0, 1.0 - std::fabs(glm::dot(v, h)));
    const double fresnel = (dark * dark) * (dark * dark) * dark;
    const double specular = microfacets(n, h, glm::dot(n, l), std::fabs(glm::dot(n, v)),
                                        std::max(surface.roughness, kLeastRoughness));
    const double f = kDielectricF0 + (1.0 - kDielectricF0) * fresnel;
    const glm::dvec3 dielectric = surface.base * ((1.0 - f) / M_PI) + glm::dvec3(f * specular);
    const glm::dvec3 metal = specular * (surface.base + (1.0 - surface.base) * fresnel);
    return dielectric * (1.0 - surface.metallic) + metal * surface.metallic;
}

}  // namespace edgewise
