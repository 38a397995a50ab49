// The sphere-tracing page's pictures, after Figures 7, 8 and 9 of Keinert et al. 2014.
#pragma once

#include "paper_figures/sphere_tracing_measure.h"

namespace edgewise::figures {

/// Throws Interrupted when cancelled.
std::vector<PictureRow> sphereTracingPictures(const SphereTracingEffort& effort, Progress& progress);

}  // namespace edgewise::figures
