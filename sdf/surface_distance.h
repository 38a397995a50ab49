// About how far the surface is from a place.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/evaluate.h"
#include "sdf/tape_at.h"

namespace edgewise::sdf {

/// Fields are trusted to be no flatter.
inline constexpr double kLeastSlope = 0.1;

/// By value and slope; the value alone where that is certainly less than the limit.
inline double distanceBy(const TapeAt& tape, const glm::dvec3& p_world, double limit) {
    const TapeView own = tape(p_world);
    const double value = std::abs(valueAt(own, p_world));
    if (value < kLeastSlope * limit) return value;
    return value / std::max(glm::length(gradientAt(own, p_world).gradient), kLeastSlope);
}

}  // namespace edgewise::sdf
