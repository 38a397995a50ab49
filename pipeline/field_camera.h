// Rays of a camera through positions on the screen, for SDF scenes.
#pragma once

#include "pipeline/screen_map.h"
#include "sdf/sphere_trace.h"

namespace edgewise {

class FieldCamera {
  public:
    /// Rays end `far` from the eye (orthographic: the image plane).
    FieldCamera(const ResolvedCamera& camera, const Film& film, double far);
    sdf::FieldRay ray(glm::dvec2 p_px) const;

  private:
    ScreenMap map_;
    glm::dmat4 world_from_camera_;
    double far_;
};

}  // namespace edgewise
