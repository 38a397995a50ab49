// A shipped SDF scene's picture by any method.
#pragma once

#include <string>

#include "pipeline/methods/method.h"

namespace edgewise::figures {

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
    MethodInput input(Progress& progress) const { return {scene, camera, film, filter, options, progress}; }
};

}  // namespace edgewise::figures
