// A scene from a small file that a test made.
#pragma once

#include "pipeline/load_gltf.h"
#include "tests/pipeline/tiny_gltf_file.h"

namespace edgewise::test {

inline Scene loadTiny(const TinyGltf& file, const LoadOptions& options = {}) {
    const TempFolder folder;
    writeFile(folder / "a.glb", file.asGlb());
    return loadGltf(folder / "a.glb", options);
}

inline LoadOptions atTime(double seconds, const std::string& animation = "") {
    LoadOptions options;
    options.time = seconds;
    options.animation = animation;
    return options;
}

}  // namespace edgewise::test
