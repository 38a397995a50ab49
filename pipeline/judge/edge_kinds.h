// What kind of edge crosses a pixel of an SDF scene, by what rays meet there and not by how it looks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/field_tracer.h"
#include "sdf/ray_grid.h"

namespace edgewise::judge {

/// In the order in which a pixel that has several is the one or the other's.
enum class EdgeKind : std::uint8_t {
    kNone,
    kContour,    ///< depth leaps, within one shape too, or a surface ends before nothing
    kInternal,   ///< one surface, or two that touch, turns by more than 15 degrees to the next sub-sample
    kTexture,    ///< another material or another colour of a pattern
    kShadow,     ///< another set of lights is seen
    kReflection  ///< what mirrors and glass show, and highlights: the light alone differs
};
inline constexpr EdgeKind kEdgeKinds[]{EdgeKind::kContour, EdgeKind::kInternal, EdgeKind::kTexture,
                                       EdgeKind::kShadow, EdgeKind::kReflection};
/// "contour", ...; "none".
const char* nameOf(EdgeKind kind);
/// Where pictures of them and plots are to agree: sRGB, "#rrggbb".
const char* colorOf(EdgeKind kind);
/// <dt> and <dd> of what each is, and of the constants.
std::string edgeKindDefinitions();

/// What rays meet at the samples of one lattice; one entry a sample.
struct LatticeFacts {
    FieldSamples surface;               ///< colour: the material's, of its pattern, as if it shone
    std::vector<glm::dvec4> lit;        ///< by lights alone: nothing is mirrored or refracted
    std::vector<std::uint32_t> sights;  ///< of which lights; FieldTracer::shade()
    std::vector<glm::dvec4> seen;       ///< the picture's colour; empty: `lit`
};

/// The first kind in the order above that lies between two sub-samples of a pixel, side by side or one below
/// the other, or between one of its last and the next pixel's first. By pixel of the window, row by row.
std::vector<EdgeKind> edgeKinds(const FieldWindow& window, const sdf::RayGrid& rays,
                                const LatticeFacts& facts);

/// Of the film's crop, on a lattice of per_side^2 a pixel, whose rays end that much nearer to surfaces: on
/// the CPU, raw GLSL on Vulkan. Throws InputError for a scene that cannot be traced, Interrupted.
std::vector<EdgeKind> edgeKindsOf(const MethodInput& input, int per_side);

/// A picture of them: kNone dark.
ImageBuffer edgeKindPicture(const std::vector<EdgeKind>& kinds, const PixelBox& box);

}  // namespace edgewise::judge
