// Stage 1 for every kind of scene: a file by its name's end.
#pragma once

#include <filesystem>

#include "pipeline/load_gltf.h"
#include "pipeline/scene.h"

namespace edgewise {

/// .sdf.json and .map.glsl become a scene with a `field`, its cameras, lights and bounds; everything else is
/// read by loadGltf. Throws InputError "FILE: ELEMENT: RULE". --scene and --animation do not go with SDF
/// scenes; --time is a .map.glsl's iTime.
Scene loadScene(const std::filesystem::path& path, const LoadOptions& options = {});

/// Whether a file of that name is an SDF scene.
bool isFieldFile(const std::filesystem::path& path);

}  // namespace edgewise
