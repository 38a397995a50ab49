// Stiff scenes that take the way of a picture: triangles in the world, a camera, and the pipeline's own
// projection.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "pipeline/film.h"
#include "pipeline/judge/stability_cases.h"

namespace edgewise::judge {

using WorldTriangle = std::array<glm::vec3, 3>;

/// A camera of 90 degrees on a film whose middle is the sample of a pixel (2 i + 1 by 2 j + 1 pixels).
struct CameraView {
    glm::dmat4 world_from_camera{1.0};
    double znear = 1.0;
    glm::ivec2 pixel{37, 21};

    /// From eye space to the float32 of a file.
    glm::vec3 toWorld(const glm::dvec3& p_eye) const;
    /// The eye-space point at depth w seen `from_sample_px` beside the sample.
    glm::dvec3 seenAt(glm::dvec2 from_sample_px, double w) const;
};

/// Triangles of one node and a double-sided material through resolveCamera and project; how that went.
StiffScene throughCamera(const std::vector<WorldTriangle>& triangles, const CameraView& view);

}  // namespace edgewise::judge
