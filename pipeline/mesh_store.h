// Meshes that several processes make their pictures of, each made once.
#pragma once

#include <filesystem>
#include <optional>

#include "pipeline/methods/method.h"
#include "sdf/surface_mesh.h"

namespace edgewise {

/// What a film's mesh is made of, but for its light.
struct FilmPolygons {
    sdf::SurfaceMesh mesh;
    MeshReport report;
};

/// A file a mesh, named by how it was chosen: the scene, the camera and the film are those of the folder.
class MeshStore {
  public:
    explicit MeshStore(std::filesystem::path folder) : folder_(std::move(folder)) {}
    /// None: it is not there, or not whole.
    std::optional<FilmPolygons> find(const MeshChoice& choice) const;
    /// Does nothing where the folder cannot be written to.
    void keep(const MeshChoice& choice, const FilmPolygons& polygons) const;

  private:
    std::filesystem::path fileOf(const MeshChoice& choice) const;
    std::filesystem::path folder_;
};

}  // namespace edgewise
