// Clipping in eye space: near and far planes, and the screen's guard band, before anything is divided by w.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

#include "pipeline/screen_map.h"

namespace edgewise {

/// A point of eye space, and what rounding it to double lost: where an edge meets a plane at an angle of
/// 1e-10, a rounded coordinate moves the crossing by 1e-6.
struct EyePoint {
    glm::dvec3 p{0.0}, rest{0.0};
};

/// The map's image in double-double, p rounded to nearest.
EyePoint refined(const glm::dmat4& camera_from_world, const glm::dvec3& p_world);

/// The polygon of a clipped triangle: at most nine corners, and room for rounded ones that are not quite
/// convex.
struct ClipPolygon {
    static constexpr int kCapacity = 32;
    std::array<EyePoint, kCapacity> eye;
    std::array<std::uint32_t, kCapacity> vertex;  ///< kNone for a corner that clipping made
    int size = 0;

    void push(const EyePoint& p, std::uint32_t id) {
        if (size == kCapacity) return;
        eye[size] = p;
        vertex[size++] = id;
    }
};

/// The half-spaces of what can be seen. Bit i of a code says that a point lies outside plane i.
class ClipVolume {
  public:
    static constexpr int kPlanes = 6;

    ClipVolume(const Camera& camera, const ScreenMap& map);

    /// Of the map's exact image. `p_eye` comes in double; it is rounded to nearest where that could not tell
    /// a side, so that w > 0 stays true of what is inside.
    std::uint8_t outcode(const glm::dmat4& camera_from_world, const glm::dvec3& p_world,
                         glm::dvec3& p_eye) const;

    /// Clips against the planes in `codes`. A new corner depends on its edge's two endpoints alone, not on
    /// their order: neighbours get the same bits and no crack opens. It is off by some 2^-100 of the way from
    /// its edge's nearer end: below the grid unless both ends are 2^50 times the near plane away. Fewer than
    /// three corners: nothing is left.
    void clip(ClipPolygon& polygon, std::uint8_t codes) const;

  private:
    /// Inside is h(p) = a . p + b >= 0.
    struct Plane {
        glm::dvec3 a{0.0};
        double b = 0.0;
        double at(const glm::dvec3& p) const { return ((a.x * p.x + a.y * p.y) + a.z * p.z) + b; }
    };
    bool inside(int plane, const EyePoint& p) const;
    EyePoint crossing(int plane, const EyePoint& p, const EyePoint& q) const;

    std::array<Plane, kPlanes> planes_;
    int plane_count_ = kPlanes;
};

}  // namespace edgewise
