// Do triangles meet where they should not?
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "sdf/surface_mesh.h"

namespace edgewise::sdf {

/// Whether two triangles have a point in common that is no common vertex or edge. Never no where exact
/// arithmetic says yes; yes too where rounding leaves it open.
bool trianglesMeet(std::span<const glm::dvec3> positions, const Triangle& a, const Triangle& b);

/// All such pairs of triangles of which one is doubtful.
std::vector<std::pair<std::uint32_t, std::uint32_t>> meetingPairs(std::span<const glm::dvec3> positions,
                                                                  std::span<const Triangle> triangles,
                                                                  const std::vector<bool>& doubtful);

}  // namespace edgewise::sdf
