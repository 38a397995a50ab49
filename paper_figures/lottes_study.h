// "Sphere Tracing AA" (Lottes 2016), frame by frame: how frames differ, and what their mean tends to.
#pragma once

#include <string>
#include <vector>

#include "pipeline/image_buffer.h"
#include "pipeline/methods/lottes.h"
#include "pipeline/progress.h"

namespace edgewise::figures {

struct LottesEffort {
    std::string scene = "thin";
    int width = 320, height = 180;
    int frames = 64, shown = 3;
    int reference_side = 16;  ///< samples a pixel along each axis
    double grain = 0.01;
};

/// After so many frames.
struct LottesPoint {
    int frames = 0;
    double deviation_of_mean = 0.0;  ///< RMS; 0 with one frame
    double rmse = 0.0;               ///< of the mean against the reference
};

/// One of the rays that make a pixel.
struct LottesWeight {
    glm::ivec2 pixel;  ///< whose ray it is
    LottesRay ray;
    double f = 0.0;  ///< of its distance to the pixel's middle
};

struct LottesStudy {
    LottesEffort effort;
    std::vector<ImageBuffer> frames;  ///< the first ones
    ImageBuffer mean, mean_without_coverage, reference, none;
    double deviation = 0.0;  ///< RMS from frame to frame, with grain
    double none_rmse = 0.0, rmse_without_coverage = 0.0;
    std::vector<LottesPoint> points;  ///< 1, 2, 4, ... frames
    glm::ivec2 pixel{0};              ///< where the 11 rays differ most in colour
    std::vector<LottesWeight> rays;   ///< of that pixel in frame 0: its own and its neighbours'
    LottesSettings settings;
};

/// Throws Interrupted when cancelled.
LottesStudy studyLottes(const LottesEffort& effort, Progress& progress);

}  // namespace edgewise::figures
