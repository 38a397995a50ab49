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

/// Near t_start, to 1/64 of the pixel's radius where the field is convex along the ray: between two places of
/// which one comes nearer and one leads away, no tangent falls lower. Where the field is the greater one of
/// two, its faces' edge: exact for planes, whatever their slopes. None where the ray is within the solid
/// there, or 20 evaluations find no such two.
std::optional<ClosestApproach> closestApproach(const CellTapes& cells, const FieldRay& ray, double t_start);

}  // namespace edgewise::sdf
