// The colour of a triangle where a (pixel, owner) is shaded.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "pipeline/project.h"
#include "pipeline/screen_map.h"
#include "pipeline/texture.h"

namespace edgewise {

/// The default rig for lit materials, fixed to the camera (x right, y up, z towards the viewer):
///     colour = base colour (ambient + sum over lights of max(0, n . towards) intensity)
/// A white surface that faces the key light gets 0.15 + 0.8 + 0.2 * 12/49 = 0.999; none gets more than 1.03.
struct RigLight {
    glm::dvec3 towards;  ///< unit, from the surface to the light
    double intensity;
};
inline constexpr double kRigAmbient = 0.15;
inline constexpr RigLight kRigKey{{2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0}, 0.8};
inline constexpr RigLight kRigFill{{-6.0 / 7.0, 2.0 / 7.0, 3.0 / 7.0}, 0.2};

/// What a surface sends to the eye where it is shaded.
struct Shade {
    glm::dvec3 color{0.0};  ///< linear, as if nothing shone through
    double alpha = 1.0;     ///< opacity: 1 for opaque materials, 0 or 1 for masks, [0, 1] for blended ones
    bool operator==(const Shade&) const = default;
};

/// Shades owners of one projected scene; refers to all its arguments. Safe to use from many threads.
/// All methods want an owner that has pieces.
class Shading {
  public:
    Shading(const Scene& scene, const ResolvedCamera& camera, const Film& film, const ScreenScene& screen,
            const ScreenPieces& pieces);

    /// At the owner's point nearest to the sample on the screen (the near-clipped triangle, occluded or not).
    Shade closest(Owner owner, glm::dvec2 sample_px) const;

    /// At a point that lies on the owner.
    Shade atPoint(Owner owner, glm::dvec2 p_px) const;

    /// The shade of all of the owner where it cannot vary: then closest() and atPoint() give exactly this.
    std::optional<Shade> constant(Owner owner) const;

    /// What the lights see at a point that lies on the owner: unit, eye space, towards the viewer.
    glm::dvec3 normal(Owner owner, glm::dvec2 p_px) const;

    /// From the sample to the point where closest() shades.
    glm::dvec2 closestOffset(Owner owner, glm::dvec2 sample_px) const;

  private:
    struct Surface;
    struct Location;
    Surface surfaceOf(Owner owner) const;
    Location locate(const Surface& surface, glm::dvec2 image_plane) const;
    Shade shadeAt(const Surface& surface, glm::dvec2 image_plane) const;
    glm::dvec3 flatNormal(const Surface& surface) const;
    glm::dvec3 cornerNormal(const Surface& surface, int corner) const;
    glm::dvec3 normalAt(const Surface& surface, const glm::dvec3& barycentric) const;
    glm::dvec4 textureAt(const Surface& surface, const Location& at) const;
    const MipPyramid* pyramidOf(const Surface& surface) const;
    std::optional<glm::dvec4> constantBase(const Surface& surface) const;
    std::optional<Shade> constant(const Surface& surface) const;
    double alphaOf(const Surface& surface, double base_alpha) const;

    const Scene& scene_;
    glm::dmat4 camera_from_world_;
    ScreenMap map_;
    const ScreenScene& screen_;
    const ScreenPieces& pieces_;
    std::vector<std::optional<MipPyramid>> pyramids_;  ///< by image; those that a material uses
};

/// What the rig sends back from a white surface with this unit normal (eye space).
double rigLight(const glm::dvec3& normal_eye);

}  // namespace edgewise
