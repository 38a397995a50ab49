// Dual contouring of a field that is asked at many points at once.
#pragma once

#include "sdf/point_bricks.h"
#include "sdf/surface_mesh.h"

namespace edgewise::sdf {

/// Ju et al. 2002 with a vertex a loop of a cell, so that the mesh is manifold, each within its cell. Sharp
/// edges and corners are kept as far as the field's numbers tell them from round ones. Without materials and
/// normals. Triangles may meet where the surface is finer than cells.
SurfaceMesh dualOfPoints(const PointField& field, const Lattice& lattice, const PointBricks& bricks,
                         std::uint64_t& cells);

}  // namespace edgewise::sdf
