// Unlit triangles in pixels of a small film: what figures of single pixels are drawn from.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "pipeline/film.h"

namespace edgewise::figures {

struct FlatTriangle {
    std::array<glm::dvec2, 3> p_px;  ///< x right, y down; multiples of 2^-10
    double depth = 1.0;              ///< the smaller one is nearer
    glm::dvec3 color{1.0};           ///< linear
};

/// Triangle i has index i, and is seen from both sides.
Scene flatScene(std::span<const FlatTriangle> triangles, int side_px);
/// Of a film of side_px x side_px pixels, under which p_px is where it says.
ResolvedCamera flatCamera(int side_px);

}  // namespace edgewise::figures
