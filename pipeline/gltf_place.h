// From the mesh's space to the world: by the node's transform, or by a skin.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "pipeline/scene.h"

namespace edgewise {

/// Moves positions, normals and tangents by one affine map; flips the winding, and the tangents' sign, if it
/// mirrors. Throws InputError "WHERE: ..." for a vertex that is not finite in the world.
void placeRigidly(Geometry& geometry, const glm::dmat4& world_from_node, const std::string& where);

/// Moves each vertex by its own affine map; a triangle's winding flips where its first corner's map mirrors.
/// Positions are rounded to float32 (adoptPositions). Throws InputError "WHERE: ..." for a vertex that is not
/// finite then.
void placeSkinned(Geometry& geometry, const std::vector<glm::dmat4>& world_from_vertex,
                  const std::string& where);

}  // namespace edgewise
