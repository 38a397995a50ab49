// A surface as triangles, in double: what polygonizers make.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace edgewise::sdf {

using Triangle = std::array<std::uint32_t, 3>;

struct SurfaceMesh {
    std::vector<glm::dvec3> position_world;
    std::vector<Triangle> triangles;  ///< counter-clockwise seen from outside
    // Below: one a triangle, or empty where they were not asked for.
    std::vector<std::uint32_t> material;  ///< of the shape whose value wins there; kNoMaterial: of none
    std::vector<std::array<glm::dvec3, 3>>
        normal_world;                              ///< unit, at its corners, from its own side of creases
    std::vector<std::array<glm::dvec3, 3>> color;  ///< linear, at its corners; empty: the material's
};

}  // namespace edgewise::sdf
