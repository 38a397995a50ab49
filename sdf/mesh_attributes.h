// Materials and normals of a mesh's triangles.
#pragma once

#include "sdf/surface_mesh.h"
#include "sdf/tape_at.h"

namespace edgewise::sdf {

/// At each triangle's centre.
void findMaterials(const TapeAt& tape, SurfaceMesh& mesh);

/// From gradients a little inside the triangles, so that each side of a crease has its own.
void findNormals(const TapeAt& tape, SurfaceMesh& mesh);

}  // namespace edgewise::sdf
