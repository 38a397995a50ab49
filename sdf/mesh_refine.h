// More triangles where a mesh is off its surface.
#pragma once

#include "sdf/mesh_attributes.h"
#include "sdf/mesh_limits.h"
#include "sdf/surface_mesh.h"

namespace edgewise::sdf {

/// Divides edges whose middles are further off than the limits; the new vertex is put on the surface, on its
/// sharp edge where it has one there. Edges are turned, and vertices moved or drawn into neighbours, where
/// that takes the mesh there. Changes by which triangles would come to meet are not made: the mesh goes
/// through itself no more than before. `left`: gets places
/// in bricks where so many edges are off that smaller cells are the way; none: nothing is left to them. Gives
/// how many were added. Of materials and normals none are kept.
std::size_t refineMesh(SurfaceMesh& mesh, const TapeAt& tape, double step, const SharpCells& sharp,
                       const MeshLimits& limits, std::vector<glm::dvec3>* left = nullptr);

}  // namespace edgewise::sdf
