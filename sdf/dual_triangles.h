// A dual complex as triangles that do not meet.
#pragma once

#include "sdf/dual_cells.h"
#include "sdf/surface_mesh.h"

namespace edgewise::sdf {

/// Vertices are put where they belong, as far as that is in or by their cells, and polygons divided along the
/// diagonal nearer to the surface. Where triangles meet, vertices go back towards the middles of their loops,
/// and polygons get vertices of their own. `mended`: how many such polygons there were.
SurfaceMesh dualTriangles(const Lattice& lattice, const TapeAt& tape, DualComplex& complex,
                          std::uint64_t& mended);

}  // namespace edgewise::sdf
