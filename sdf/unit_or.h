// A direction where there is one.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace edgewise::sdf {

/// Unit, or `other` where v has no direction.
inline glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& other) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : other;
}

}  // namespace edgewise::sdf
