// The file's planes in eye space, and from there depth as an affine function of the screen. Double-double
// throughout, rounded once at the end: triangles that share a plane in the file share the bits of its depth.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "analytic/screen_triangle.h"
#include "pipeline/coplanar.h"
#include "pipeline/screen_map.h"

namespace edgewise {

/// n . p = d; n is cross(b - a, c - a) of the representative, d > 0 where its back is seen (perspective).
struct EyePlane {
    std::array<f64::dd, 3> n;
    f64::dd d;

    /// Positive where the eye sees the front, 0 edge-on: the sign of a product that was formed in
    /// double-double.
    double facing(bool perspective) const { return perspective ? -d.hi : n[2].hi; }

    /// Unit, towards the viewer.
    glm::dvec3 unitNormal(bool perspective) const;
};

/// One for each plane of the groups.
std::vector<EyePlane> makeEyePlanes(const Scene& scene, const CoplanarGroups& groups,
                                    const glm::dmat4& camera_from_world);

/// Depth relative to the map's anchor: 1/w = n.(u, v, -1)/d for perspective, with no vertex projected, so
/// triangles partly behind the eye are no special case; z_eye for orthographic. None: the plane is seen
/// edge-on.
std::optional<DepthPlane> depthPlane(const EyePlane& plane, const ScreenMap& map);

}  // namespace edgewise
