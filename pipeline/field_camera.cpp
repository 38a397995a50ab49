#include "pipeline/field_camera.h"

namespace edgewise {

FieldCamera::FieldCamera(const ResolvedCamera& camera, const Film& film, double far)
    : map_(makeScreenMap(camera, film)), world_from_camera_(camera.camera.world_from_camera), far_(far) {}

/// Perspective: the pixel's side is 1 / scale at depth 1, which is sqrt(1 + u^2 + v^2) along the ray.
sdf::FieldRay FieldCamera::ray(glm::dvec2 p_px) const {
    const glm::dvec2 at = map_.toImagePlane(p_px, glm::dvec2(0.0));
    const glm::dmat3 turn(world_from_camera_);
    const glm::dvec3 eye(world_from_camera_[3]);
    const double radius = 0.5 / map_.scale_px;
    if (!map_.perspective)
        return {eye + turn * glm::dvec3(at, 0.0), turn * glm::dvec3(0, 0, -1), 0.0, far_, radius, 0.0};
    const glm::dvec3 way(at, -1.0);
    const double size = glm::length(way);
    return {eye, turn * (way / size), 0.0, far_, 0.0, radius / size};
}

}  // namespace edgewise
