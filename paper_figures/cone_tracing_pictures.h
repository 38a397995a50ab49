// The cone-tracing page's pictures, after Figures 5, 8 and 9 of Chubarau et al. 2023.
#pragma once

#include "paper_figures/cone_tracing_measure.h"

namespace edgewise::figures {

/// Throws Interrupted when cancelled.
std::vector<PictureRow> coneTracingPictures(const ConeTracingEffort& effort, Progress& progress);

}  // namespace edgewise::figures
