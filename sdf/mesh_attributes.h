// Materials and normals of a mesh's triangles.
#pragma once

#include "sdf/mesh_lattice.h"
#include "sdf/surface_mesh.h"

namespace edgewise::sdf {

/// The tape of the brick around a point, or the whole one.
class TapeAt {
  public:
    TapeAt(const Tape& whole, const Lattice& lattice, const BrickList& bricks);
    TapeView operator()(const glm::dvec3& p_world) const;
    TapeView whole() const { return TapeView(whole_); }

  private:
    const Tape& whole_;
    const Lattice& lattice_;
    const BrickList& bricks_;
};

/// At each triangle's centre.
void findMaterials(const TapeAt& tape, SurfaceMesh& mesh);

/// From gradients a little inside the triangles, so that each side of a crease has its own.
void findNormals(const TapeAt& tape, SurfaceMesh& mesh);

}  // namespace edgewise::sdf
