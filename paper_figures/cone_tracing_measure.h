// Shipped SDF scenes by every method that traces them, compared as `edgewise compare` does.
#pragma once

#include <glm/vec2.hpp>

#include "paper_figures/cone_tracing.h"

namespace edgewise::figures {

struct ConeTracingEffort {
    bool quick = false;
    std::vector<std::string> scenes;
    glm::ivec2 size{320, 180};        ///< of what is judged
    glm::ivec2 timed_size{640, 360};  ///< of what is timed for the aims; 0: nothing more is timed
    int runs = 3;
    double budget_seconds = 120.0;  ///< a method and scene
    int reference_side = 16;        ///< samples a pixel along each axis
    glm::ivec2 picture_size{320, 180};
};

/// A cone as wide as a pixel has area, sqrt(2 / pi) of the paper's, which goes through the pixel's corners:
/// an edge is smeared over 1 px^2 and not over 1.57.
inline constexpr const char* kPixelAreaCone = "ctss:coverage=0.8";

/// Throws Interrupted when cancelled.
ConeTracing measureConeTracing(const ConeTracingEffort& effort, Progress& progress);

}  // namespace edgewise::figures
