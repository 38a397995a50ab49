// Stage 1: a .gltf or .glb file becomes a scene in world space.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "pipeline/scene.h"

namespace edgewise {

/// Scenes with more triangles or vertices (instances counted) are refused: a stated limit, FailureError.
inline constexpr std::size_t kMaxTriangles = std::size_t(1) << 27;
inline constexpr std::size_t kMaxVertices = std::size_t(1) << 27;

struct LoadOptions {
    std::string scene;  ///< --scene NAME|INDEX; empty: the file's own, else the first, else every root node
    /// --time: seconds into an animation; none: the rest pose, which no animation moves.
    std::optional<double> time;
    std::string animation;                          ///< --animation NAME|INDEX; empty: the first
    std::function<void(double fraction)> progress;  ///< called with 0..1; may throw to stop
};

/// Reads a glTF 2.0 file. Every triangle counts, degenerate ones included, in depth-first order of nodes,
/// then primitives, then triangles; a node's children follow it in the file's order. What the file uses and
/// edgewise does not draw is listed in Scene::ignored. A material's texture whose coordinates a primitive
/// lacks is read at (0, 0). Files outside the scene's folder are never opened. Throws InputError "FILE:
/// ELEMENT: RULE" for anything malformed, FailureError past a stated limit.
Scene loadGltf(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace edgewise
