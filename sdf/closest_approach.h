// Where a ray that misses a solid passes nearest to it.
#pragma once

#include <optional>

#include "sdf/cell_tapes.h"
#include "sdf/sphere_trace.h"

namespace edgewise::sdf {

struct ClosestApproach {
    double t = 0.0;
    glm::dvec3 surface_world{0.0};   ///< the solid's nearest point
    glm::dvec3 outwards_world{0.0};  ///< unit, from there to the ray
    double distance = 0.0;           ///< > 0
};

/// Near t_start. Steps to where the ray passes the nearest point of the last step's distance and slope; none
/// where that does not settle, or the ray is within the solid.
std::optional<ClosestApproach> closestApproach(const CellTapes& cells, const FieldRay& ray, double t_start);

}  // namespace edgewise::sdf
