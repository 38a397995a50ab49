// Screen scenes made for their difficulty, without a file or a camera.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "analytic/screen_triangle.h"

namespace edgewise::judge {

/// Rounds to the screen's grid.
glm::dvec2 toGrid(glm::dvec2 px);

/// Triangles of the next owner index each; corners go to the grid, equal ones in space are one vertex, and a
/// triangle without area there is dropped as `project` would.
class StiffSceneBuilder {
  public:
    explicit StiffSceneBuilder(glm::dvec2 anchor_px) { scene_.anchor_px = toGrid(anchor_px); }

    /// (x, y) px and the depth there; the plane through them is rounded to doubles once.
    void add(const std::array<glm::dvec3, 3>& corners);
    void add(const std::array<glm::dvec2, 3>& corners, const DepthPlane& plane);

    const ScreenScene& scene() const { return scene_; }

  private:
    void push(std::array<glm::dvec2, 3> px, std::uint32_t plane);

    ScreenScene scene_;
    std::vector<glm::dvec2> vertices_;
    Owner next_ = 0;
};

}  // namespace edgewise::judge
