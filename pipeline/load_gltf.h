// Stage 1: a .gltf or .glb file becomes a scene in world space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "pipeline/scene.h"

namespace edgewise {

/// What a scene may hold at most, instances counted; more is a FailureError.
struct LoadLimits {
    std::size_t triangles = std::size_t(1) << 27;
    std::size_t vertices = std::size_t(1) << 27;
    std::uint64_t image_texels = std::uint64_t(1) << 26;  ///< of one picture; 16 bytes each once decoded
};

struct LoadOptions {
    std::string scene;  ///< --scene NAME|INDEX; empty: the file's own, else the first, else every root node
    /// --time: seconds into an animation; none: the rest pose, which no animation moves.
    std::optional<double> time;
    std::string animation;  ///< --animation NAME|INDEX; empty: the first
    LoadLimits limits;
    std::function<void(double fraction)> progress;  ///< called with 0..1; may throw to stop
};

/// Reads a glTF 2.0 file. Every triangle counts, degenerate ones included, in depth-first order of nodes,
/// then primitives, then triangles; a node's children follow it in the file's order. What the file uses and
/// edgewise does not draw is listed in Scene::ignored. A material's texture whose coordinates a primitive
/// lacks is read at (0, 0). Files outside the scene's folder are never opened. Throws InputError "FILE:
/// ELEMENT: RULE" for anything malformed, FailureError past a stated limit.
Scene loadGltf(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace edgewise
