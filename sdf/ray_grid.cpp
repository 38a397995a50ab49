#include "sdf/ray_grid.h"

namespace edgewise::sdf {

FieldRay RayGrid::ray(const glm::dvec2& p_px) const {
    FieldRay ray;
    ray.t_min = t_min, ray.t_max = t_max;
    if (perspective) {
        ray.origin_world = eye_world;
        ray.direction_world = glm::normalize(onPlane(p_px));
        ray.pixel_slope = halfPixel();
    } else {
        ray.origin_world = onPlane(p_px);
        ray.direction_world = axis_world;
        ray.pixel_radius = halfPixel();
    }
    return ray;
}

Beam RayGrid::beam(const glm::dvec2& low_px, const glm::dvec2& high_px) const {
    Beam beam;
    const glm::dvec3 middle = onPlane(0.5 * (low_px + high_px));
    if (!perspective) {
        beam.origin_world = middle, beam.axis_world = axis_world;
        beam.half_width = glm::length(onPlane(high_px) - middle);
        return beam;
    }
    beam.origin_world = eye_world, beam.axis_world = glm::normalize(middle);
    for (const glm::dvec2& corner :
         {low_px, high_px, glm::dvec2(low_px.x, high_px.y), glm::dvec2(high_px.x, low_px.y)}) {
        const glm::dvec3 along = glm::normalize(onPlane(corner));
        beam.cosine = std::min(beam.cosine, glm::dot(along, beam.axis_world));
        beam.sine = std::max(beam.sine, glm::length(glm::cross(along, beam.axis_world)));
    }
    // A narrow beam's cosine is rounded to a larger share than its sine.
    beam.cosine = std::min(beam.cosine, std::sqrt(std::max(1.0 - beam.sine * beam.sine, 0.0)));
    beam.cosine -= 1e-15, beam.sine *= 1.0 + 1e-12;
    return beam;
}

}  // namespace edgewise::sdf
