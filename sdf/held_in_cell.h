// A vertex that may not leave its cell.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace edgewise::sdf {

/// On the way from `middle` to the target, the last place that is `rim` within the box.
inline glm::dvec3 heldInCell(const glm::dvec3& low, const glm::dvec3& high, double rim,
                             const glm::dvec3& middle, const glm::dvec3& target) {
    const glm::dvec3 from = glm::clamp(middle, low + rim, high - rim), way = target - from;
    double part = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (target[axis] > high[axis] - rim)
            part = std::min(part, (high[axis] - rim - from[axis]) / way[axis]);
        if (target[axis] < low[axis] + rim) part = std::min(part, (low[axis] + rim - from[axis]) / way[axis]);
    }
    return from + std::max(part, 0.0) * way;
}

}  // namespace edgewise::sdf
