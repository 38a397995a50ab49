// The rays of a camera's picture of an SDF scene.
#pragma once

#include "pipeline/film.h"
#include "sdf/ray_grid.h"
#include "sdf/scene_trace.h"
#include "sdf/surface_light.h"

namespace edgewise {

/// By the conventions of screen_map.h. Rays begin at the camera's znear and end at zfar or `far`, both along
/// the ray.
sdf::RayGrid rayGrid(const ResolvedCamera& camera, const Film& film, double far);

/// The picture's ray to a point, which lies at t along it.
sdf::FieldRay rayTowards(const sdf::RayGrid& grid, const glm::dvec3& p_world, double& t);

/// -1 where the eye, or every ray of an orthographic picture, begins within the solid, else 1.
double signOfView(const sdf::SceneTracer& scene, const sdf::RayGrid& grid, const Film& film);

/// The default rig (lighting.h) in front of the camera, for a scene without lights.
void addDefaultRig(const ResolvedCamera& camera, sdf::ShadingSettings& settings);

}  // namespace edgewise
