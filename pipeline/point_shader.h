// Light at points of triangles by rules of the scene's own, in the place of glTF's: meshes of SDF scenes.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace edgewise {

/// A point of a triangle as the eye sees it.
struct SeenPoint {
    std::uint32_t triangle = 0;    ///< the contract's index
    glm::dvec3 p_world{0.0};       ///< on the triangle
    glm::dvec3 normal_world{0.0};  ///< unit, interpolated, on the viewer's side
    bool back_facing = false;      ///< seen from within the solid
};

/// Safe for many threads at once.
class PointShader {
  public:
    virtual ~PointShader() = default;
    /// Linear light that leaves towards the eye.
    virtual glm::dvec3 color(const SeenPoint& point) const = 0;
};

}  // namespace edgewise
