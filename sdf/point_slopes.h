// Slopes of a field that only has values, for many points at once.
#pragma once

#include "sdf/mesh_lattice.h"
#include "sdf/mesh_qef.h"
#include "sdf/point_field.h"

namespace edgewise::sdf {

/// Half the distance of central differences in a lattice: 4 sqrt(u) of its largest coordinate, u the field's
/// rounding, so that slopes are off by about sqrt(u) / 4 of rounding, and by what curves within it.
double slopeReach(const PointField& field, const Lattice& lattice);

/// Gradients by central differences.
std::vector<glm::dvec3> slopesAt(const PointField& field, std::span<const glm::dvec3> points_world,
                                 double reach);

/// Newton's steps along slopes to where the value is 0.
void moveOnSurface(const PointField& field, double reach, int steps, std::span<glm::dvec3> points_world);

/// Points near the surface become such on it with their tangent planes; where there is no slope, the normal
/// is `planes`' own.
void makeTangent(const PointField& field, double reach, std::span<TangentPlane> planes);

}  // namespace edgewise::sdf
