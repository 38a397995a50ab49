// Where is a mesh off its surface?
#pragma once

#include "sdf/dual_cells.h"
#include "sdf/mesh_attributes.h"
#include "sdf/mesh_limits.h"
#include "sdf/surface_mesh.h"

namespace edgewise::sdf {

/// Bricks in which more than the limits was found, in order: from the mesh's edges' middles and triangles'
/// centres to the surface; from where the surface crosses cells' edges, and from where it is nearest to
/// cells' centres, to the mesh. What the mesh has missed whole is found so too.
std::vector<std::uint32_t> bricksOff(const SurfaceMesh& mesh, const MeshRequest& request,
                                     const DualComplex& complex, const SharpBricks& sharp,
                                     const MeshLimits& limits);

}  // namespace edgewise::sdf
