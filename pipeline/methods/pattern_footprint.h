// A pattern's colour over a pixel.
#pragma once

#include "sdf/surface_light.h"

namespace edgewise {

/// The mean of a material's two colours over the parallelogram p_local + u right + v down, u and v from -1/2
/// to 1/2; none where the hit has a colour of its own or the pattern does not change there.
std::optional<glm::dvec3> patternOver(const sdf::SurfaceMaterial& material, const sdf::SurfaceHit& hit,
                                      const glm::dvec3& right_local, const glm::dvec3& down_local);

}  // namespace edgewise
