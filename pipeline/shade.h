// The colour of a triangle where a (pixel, owner) is shaded.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/brdf.h"
#include "pipeline/lighting.h"
#include "pipeline/project.h"
#include "pipeline/screen_map.h"
#include "pipeline/shading_text.h"
#include "pipeline/surface_lanes.h"
#include "pipeline/texture.h"

namespace edgewise {

/// What a surface sends to the eye where it is shaded.
struct Shade {
    glm::dvec3 color{0.0};  ///< linear, as if nothing shone through
    double alpha = 1.0;     ///< opacity: 1 for opaque materials, 0 or 1 for masks, [0, 1] for blended ones
    bool operator==(const Shade&) const = default;
};

/// Three vertices have one value.
template <class Vector>
bool sameAtCorners(const std::vector<Vector>& values, const std::array<std::uint32_t, 3>& vertex) {
    return values[vertex[0]] == values[vertex[1]] && values[vertex[0]] == values[vertex[2]];
}

/// Shades owners of one projected scene; refers to all its arguments. Safe to use from many threads.
/// All methods want an owner that has pieces.
///
///     lit      color = sum over lights of brdf(n, v, l) (n . l)+ illuminance + emissive            (brdf.h)
///              and, under the default rig, + base color * kRigAmbient * occlusion
///     unlit    color = base color
///
/// A scene's own PointShader takes the place of all that, but for normals.
///
/// The ambient term is what a white room sends back from a surface that loses nothing: a dielectric's diffuse
/// and mirrored light sum up to about its base color, and a metal's f0 is its base color. So metals are not
/// black without an environment. Occlusion dims this term alone.
///
/// Normals: the file's, interpolated and normalised; else the triangle's. Seen from behind they are turned
/// round after the normal map, which turns bumps into dents as it should. A normal map's (x, y, z) is
/// 2 texel - 1, x and y times the normal scale; x points along the tangent, y along
/// cross(normal, tangent) * sign, up in the picture. Tangents: the file's TANGENT; else the derivative of the
/// position by the map's u on the triangle, made orthogonal to the normal, and the sign such that y runs
/// against v. Where u and v do not span the triangle the map is left out.
class Shading {
  public:
    class Memo;
    class Groups;

    Shading(const Scene& scene, const ResolvedCamera& camera, const Film& film, const ScreenScene& screen,
            const ScreenPieces& pieces);

    /// At the owner's point nearest to the sample on the screen (the near-clipped triangle, occluded or not).
    Shade closest(Owner owner, glm::dvec2 sample_px) const;

    /// The same, bit for bit; what does not depend on the sample is looked up in `memo`, which is one
    /// thread's and this Shading's.
    Shade closest(Owner owner, glm::dvec2 sample_px, Memo& memo) const;

    /// At a point that lies on the owner.
    Shade atPoint(Owner owner, glm::dvec2 p_px) const;

    /// The mean over the owner's points nearest to sample + offset; without offsets closest(). Where opacity
    /// varies the mean colour is that of what is there: weighted by it.
    Shade mean(Owner owner, glm::dvec2 sample_px, std::span<const glm::dvec2> offsets_px) const;

    /// The shade of all of the owner where it cannot vary: then closest() and atPoint() give exactly this.
    std::optional<Shade> constant(Owner owner) const;

    /// The shade of all of the owner where constant() has none, but one texel has the colour of all of it:
    /// then closest() and atPoint() give exactly this.
    std::optional<Shade> ofOneTexel(Owner owner) const;

    /// What the lights see at a point that lies on the owner: unit, eye space, towards the viewer.
    glm::dvec3 normal(Owner owner, glm::dvec2 p_px) const;

    /// From the sample to the point where closest() shades.
    glm::dvec2 closestOffset(Owner owner, glm::dvec2 sample_px) const;

    /// constant() has nothing.
    bool varies(Owner owner) const;

    const Lighting& lighting() const { return lighting_; }
    const ScreenMap& screenMap() const { return map_; }

    /// Of an image that some material uses so.
    const MipPyramid& pyramid(std::uint32_t image, TexelKind kind) const {
        return *(kind == TexelKind::kNormal ? normal_pyramids_ : pyramids_)[image];
    }

  private:
    /// An owner's triangle; what follows `plane` holds once placeCorners() was there.
    struct Surface {
        Owner owner = kBackground;
        const Geometry* geometry = nullptr;
        const Material* material = nullptr;
        std::array<std::uint32_t, 3> vertex{};
        bool back_facing = false;
        std::uint32_t plane = 0;
        bool mapped = false;  ///< some map asks for the footprint
        std::array<glm::dvec3, 3> p_eye{}, normal_eye{};
    };
    using Location = f64::SurfacePoint;
    /// A lit geometry of one material without maps that vary, under lights that are the same everywhere.
    std::optional<LaneMaterial> plainLookOf(const Geometry& geometry) const;
    Surface surfaceOf(Owner owner) const;
    void placeCorners(Surface& surface) const;
    void placeNormals(Surface& surface) const;
    bool isMapped(const Surface& surface) const;
    bool usesFootprint(const Surface& surface, const TextureUse& use,
                       TexelKind kind = TexelKind::kValue) const;
    bool isOneTexel(const Surface& surface) const;
    Location locate(const Surface& surface, glm::dvec2 image_plane) const;
    glm::dvec3 cornerEye(const Surface& surface, int corner) const;
    glm::dvec3 flatNormal(const Surface& surface) const;
    glm::dvec3 cornerNormal(const Surface& surface, int corner) const;
    glm::dvec3 vertexNormalAt(const Surface& surface, const glm::dvec3& barycentric) const;
    std::optional<glm::dvec4> tangentAt(const Surface& surface, const Location& at,
                                        const glm::dvec3& normal) const;
    glm::dvec3 normalAt(const Surface& surface, const Location& at) const;
    const MipPyramid* pyramidOf(const Surface& surface, const TextureUse& use,
                                TexelKind kind = TexelKind::kValue) const;
    std::optional<glm::dvec4> texelAt(const Surface& surface, const Location& at, const TextureUse& use,
                                      TexelKind kind = TexelKind::kValue) const;
    glm::dvec4 baseAt(const Surface& surface, const Location& at) const;
    Reflectance reflectanceAt(const Surface& surface, const Location& at, const glm::dvec3& base) const;
    glm::dvec3 emissiveAt(const Surface& surface, const Location& at) const;
    double ambientAt(const Surface& surface, const Location& at) const;
    glm::dvec3 litColor(const Surface& surface, const Location& at, const glm::dvec3& base) const;
    glm::dvec3 ownColor(const Surface& surface, const Location& at) const;
    Shade shadeAt(const Surface& surface, const Location& at) const;
    Shade shadeClosest(const Surface& surface, Owner owner, glm::dvec2 sample_px) const;
    bool mapVaries(const Surface& surface, const TextureUse& use, TexelKind kind = TexelKind::kValue) const;
    bool baseVaries(const Surface& surface) const;
    bool normalVaries(const Surface& surface) const;
    bool varies(const Surface& surface) const;
    std::optional<Shade> constant(Surface& surface) const;
    double alphaOf(const Surface& surface, double base_alpha) const;

    const Scene& scene_;
    glm::dmat4 camera_from_world_, world_from_camera_;
    ScreenMap map_;
    const ScreenScene& screen_;
    const ScreenPieces& pieces_;
    Lighting lighting_;
    using Pyramids = std::vector<std::optional<MipPyramid>>;
    Pyramids pyramids_, normal_pyramids_;                   ///< by image; those that a material uses
    std::vector<std::optional<LaneMaterial>> plain_looks_;  ///< by geometry
};

/// The surfaces that a thread shaded last: neighbouring pixels ask for the same few.
class Shading::Memo {
  public:
    Memo() : slots_(kSlots) {}

  private:
    friend class Shading;
    static constexpr std::size_t kSlots =
        256;  ///< about what a row of a tile of weights meets; fits a L2 cache
    struct Slot {
        Owner owner = kBackground;
        Surface surface;
        std::optional<Shade> constant;
    };
    std::vector<Slot> slots_;
};

}  // namespace edgewise
