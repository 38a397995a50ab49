// The rays of a picture.
#pragma once

#include <glm/vec2.hpp>

#include "sdf/beam.h"
#include "sdf/sphere_trace.h"

namespace edgewise::sdf {

/// Positions in pixels, x right, y down.
struct RayGrid {
    bool perspective = true;
    glm::dvec3 eye_world{0.0};  ///< perspective: where rays begin
    /// The image plane, at distance 1 from the eye, or where orthographic rays begin: pixel position (0, 0),
    /// and a pixel to the right and down.
    glm::dvec3 corner_world{0.0}, right_world{1.0, 0.0, 0.0}, down_world{0.0, -1.0, 0.0};
    glm::dvec3 axis_world{0.0, 0.0, -1.0};  ///< unit
    double t_min = 0.0, t_max = 1000.0;

    /// Half a pixel's side: all along an orthographic ray, at t = 1 of others.
    double halfPixel() const { return 0.5 * glm::length(right_world); }
    FieldRay ray(const glm::dvec2& p_px) const;
    /// All rays through a rectangle of the image plane.
    Beam beam(const glm::dvec2& low_px, const glm::dvec2& high_px) const;

  private:
    glm::dvec3 onPlane(const glm::dvec2& p_px) const {
        return corner_world + right_world * p_px.x + down_world * p_px.y;
    }
};

}  // namespace edgewise::sdf
