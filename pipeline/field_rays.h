// The rays of a camera's picture of an SDF scene.
#pragma once

#include "pipeline/film.h"
#include "sdf/ray_grid.h"
#include "sdf/surface_light.h"

namespace edgewise {

/// By the conventions of screen_map.h. Rays begin at the camera's znear and end at zfar or `far`, both along
/// the ray.
sdf::RayGrid rayGrid(const ResolvedCamera& camera, const Film& film, double far);

/// The default rig (lighting.h) in front of the camera, for a scene without lights.
void addDefaultRig(const ResolvedCamera& camera, sdf::ShadingSettings& settings);

}  // namespace edgewise
