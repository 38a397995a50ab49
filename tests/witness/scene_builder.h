// Screen scenes put together by hand: points go to the grid, corners weld, triangles turn positive.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <map>
#include <tuple>

#include "analytic/screen_triangle.h"

namespace edgewise::witness {

double toGrid(double px);
glm::dvec2 toGrid(glm::dvec2 px);

/// > 0 where a, b, c turn clockwise to the eye (y down); exact for grid points.
int orientation(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c);

class SceneBuilder {
  public:
    explicit SceneBuilder(glm::dvec2 anchor_px = {0, 0}) { scene_.anchor_px = toGrid(anchor_px); }

    /// The plane through three points (x, y in px on the grid, z), coefficients rounded once to double.
    std::uint32_t addPlane(const std::array<glm::dvec3, 3>& points);
    std::uint32_t addPlane(const DepthPlane& plane);

    /// A triangle with the next owner index; false where its corners are collinear on the grid (the index is
    /// spent).
    bool add(const std::array<glm::dvec3, 3>& points);
    bool addOnPlane(const std::array<glm::dvec2, 3>& points_px, std::uint32_t plane);

    Owner nextOwner() const { return next_owner_; }
    const ScreenScene& scene() const { return scene_; }

  private:
    std::uint32_t weld(glm::dvec2 p_px, double depth);
    double depthAt(std::uint32_t plane, glm::dvec2 p_px) const;
    bool addCorners(const std::array<glm::dvec2, 3>& p_px, const std::array<double, 3>& depth,
                    std::uint32_t plane);

    ScreenScene scene_;
    Owner next_owner_ = 0;
    std::map<std::tuple<double, double, double>, std::uint32_t> welded_;
};

}  // namespace edgewise::witness
