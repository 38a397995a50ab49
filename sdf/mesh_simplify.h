// Fewer triangles for the same surface.
#pragma once

#include "sdf/mesh_attributes.h"
#include "sdf/mesh_limits.h"
#include "sdf/surface_mesh.h"

namespace edgewise::sdf {

/// Leaves out vertices of flat parts and of straight sharp edges: one is drawn into a neighbour where every
/// triangle that it takes along stays in its plane (to 1e-9 of `step`) and keeps its side and material. The
/// surface stays what it was; where triangles come to meet all the same (slivers, whose planes are noise),
/// what is around them is left alone. Gives how many went; vertices are numbered anew.
std::size_t leaveOutFlat(SurfaceMesh& mesh, double step);

/// Leaves out vertices of curved parts too, where the new edges' middles and triangles' centres are within
/// the limits of the surface, and what was there within them of the new triangles.
std::size_t thinOut(SurfaceMesh& mesh, const TapeAt& tape, double step, const MeshLimits& limits);

}  // namespace edgewise::sdf
