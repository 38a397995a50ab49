// CGAL's Delaunay refinement as a mesher, for comparison.
#pragma once

#include <string>

#include "sdf/polygonize.h"

namespace edgewise {

/// Surface_mesher (Boissonnat and Oudot 2005): a restricted Delaunay triangulation, manifold, with angles of
/// at least 30 degrees, triangles of about a cell. Smooth surfaces alone: at a sharp edge it would not end.
/// Throws InputError that names the source where the surface has one, SceneError where it reaches the
/// lattice's end; FailureError in a build without CGAL, and where the field keeps it from ending.
sdf::SurfaceMesh cgalMesh(const sdf::MeshRequest& request, const std::string& source,
                          sdf::MeshCounts& counts);

}  // namespace edgewise
