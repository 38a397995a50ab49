// A mesh of an SDF scene as a binary glTF.
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/scene.h"
#include "sdf/surface_mesh.h"

namespace edgewise {

/// Positions become float32 here and nowhere sooner. A vertex with several normals becomes several; a
/// primitive a material. The scene's cameras and lights go with it. Throws as writeAtomically().
void writeMesh(const std::filesystem::path& path, const sdf::SurfaceMesh& mesh, const Scene& scene,
               const std::string& command);

}  // namespace edgewise
