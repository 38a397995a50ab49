// Rays of shipped SDF scenes, counted under each setting of tracing.
#pragma once

#include "paper_figures/sphere_tracing.h"

namespace edgewise::figures {

struct SphereTracingEffort {
    bool quick = false;
    int width = 1280, height = 720, runs = 3;
    std::vector<std::string> scenes, candidate_scenes, jump_scenes, pruning_scenes;
    int pruning_side = 256;
    int picture_width = 320, picture_height = 180;
};

/// Throws Interrupted when cancelled.
SphereTracing measureSphereTracing(const SphereTracingEffort& effort, Progress& progress);

}  // namespace edgewise::figures
