#include "pipeline/methods/pattern_footprint.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace edgewise {

std::optional<glm::dvec3> patternOver(const sdf::SurfaceMaterial& material, const sdf::SurfaceHit& hit,
                                      const glm::dvec3& right_local, const glm::dvec3& down_local) {
    if (hit.color || material.pattern == sdf::SurfaceMaterial::Pattern::kNone) return std::nullopt;
    const auto second = [&](double u, double v) {
        return sdf::showsSecondColor(material, hit.p_local + u * right_local + v * down_local) ? 1 : 0;
    };
    // Half a period is the narrowest that a pattern has: a footprint as wide may hide one between its
    // corners.
    const double width = std::max(glm::length(right_local), glm::length(down_local));
    const int corners = second(-0.5, -0.5) + second(0.5, -0.5) + second(-0.5, 0.5) + second(0.5, 0.5);
    const int centre = second(0.0, 0.0);
    if (width < 0.25 * material.pattern_size && corners == 4 * centre) return std::nullopt;
    const int side = std::clamp(static_cast<int>(8.0 * width / material.pattern_size), 8, 32);
    int count = 0;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) count += second((i + 0.5) / side - 0.5, (j + 0.5) / side - 0.5);
    return glm::mix(material.color, material.second_color, count / static_cast<double>(side * side));
}

}  // namespace edgewise
