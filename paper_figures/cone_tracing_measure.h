// Pictures of shipped SDF scenes by the methods of cone tracing, timed and judged.
#pragma once

#include "paper_figures/cone_tracing.h"
#include "pipeline/methods/method.h"

namespace edgewise::figures {

struct ConeTracingEffort {
    bool quick = false;
    std::vector<std::string> scenes;
    int width = 640, height = 360;  ///< of what is judged
    int timed_width = 1280, timed_height = 720, runs = 3;
    int reference_side = 16, finer_side = 24;  ///< samples a pixel along each axis
    int facts_side = 8;                        ///< likewise, for the kinds of edges
    int picture_width = 320, picture_height = 180;
};

/// A shipped scene on a film, as `edgewise render` shows it on the CPU with a filter of one pixel's box.
struct ConeView {
    Scene scene;
    Film film;
    ResolvedCamera camera;
    Prefilter filter = makePrefilter("box", {}, {});
    RenderOptions options;

    ConeView(const std::string& name, int width, int height);
    /// Throws Interrupted when cancelled.
    MethodResult made(const std::string& method, Progress& progress) const;
    /// As ssaa:K, but rays end K times nearer to surfaces: within a pixel of a sample's size. ssaa:K itself
    /// grows outlines by what rays of a whole pixel end before them.
    MethodResult reference(int per_side, Progress& progress) const;
    MethodInput input(Progress& progress) const { return {scene, camera, film, filter, options, progress}; }
};

/// Throws Interrupted when cancelled.
ConeTracing measureConeTracing(const ConeTracingEffort& effort, Progress& progress);

}  // namespace edgewise::figures
