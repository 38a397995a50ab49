// Which side of a triangle is seen, by double arithmetic where that is sure: most triangles need nothing
// better.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "pipeline/scene.h"
#include "pipeline/screen_map.h"

namespace edgewise {

class Facing {
  public:
    Facing(const Scene& scene, const glm::dmat4& camera_from_world, const ScreenMap& map);

    /// 1: the front of a triangle of the geometry, -1: its back; 0: rounding leaves it open, or the plane is
    /// so nearly edge-on that its depth might not be usable. Corners as camera_from_world, in double, gives
    /// them.
    int side(std::uint32_t geometry, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) const;

  private:
    bool perspective_;
    double steepest_;  ///< a depth's largest coefficient is at most this times |n|, |d| over the divisor
    std::vector<double>
        error_;  ///< by geometry: how far a rounded corner lies from the file's, along an axis
};

}  // namespace edgewise
