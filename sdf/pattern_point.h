// Where patterns are asked: slightly within the solid.
//
// A hit is off the surface by rounding, or by as much as its threshold lets it be. Where the surface lies on
// a boundary of the pattern's cells (a floor at y = 0 under cubes with a corner at the origin), the hit
// itself would be in the one cell or the other by chance.
#pragma once

#include <glm/vec3.hpp>

#include "sdf/evaluate.h"
#include "sdf/surface_tracer.h"

namespace edgewise::sdf {

/// Of a hit `height` above the surface (negative: below), to first order: as far below it as the hit is
/// above, so that the surface may lie half as far off as it seems; and 512 roundings of the place at `t`
/// along its ray, of which the hit takes 3 and each change of frame up to 6.
glm::dvec3 patternPoint(const glm::dvec3& p_world, const glm::dvec3& outward, double height, double t);

/// Gives a hit of the field whose p_world and t are known its normal, and of the tree's winning branch there
/// the material, one of `materials`, and the pattern's point in its frame. Gives back the height of the hit
/// above the surface, to first order; 0 where the field has no slope. A value that is not known, NaN, is the
/// field's there.
double describeHit(const TapeView& tape, SurfaceHit& hit, std::size_t materials);

}  // namespace edgewise::sdf
