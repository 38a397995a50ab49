// What kind of edge crosses a pixel of an SDF scene, by what the program itself meets there.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/field_tracer.h"
#include "sdf/ray_grid.h"

namespace edgewise::figures {

enum class EdgeKind : std::uint8_t {
    kNone,
    kContour,   ///< depth leaps, or a surface ends before nothing
    kInternal,  ///< one surface turns, by more than 15 degrees from a sub-sample to the next
    kTexture,   ///< another material or another colour of a pattern
    kLight      ///< the light alone differs: borders of shadows, of what is mirrored and refracted
};
inline constexpr EdgeKind kEdgeKinds[]{EdgeKind::kContour, EdgeKind::kInternal, EdgeKind::kTexture,
                                       EdgeKind::kLight};
const char* nameOf(EdgeKind kind);

/// Of the same lattice of samples: what rays meet, with the surfaces' own colours and with their light.
struct SampledFacts {
    FieldSamples surface;           ///< colour: the material's, of its pattern
    std::vector<glm::dvec4> color;  ///< as it is seen
};

/// The first kind in the order above that lies between two sub-samples of a pixel, side by side or one below
/// the other, or between one of its last and the next pixel's first. By pixel of the window, row by row.
std::vector<EdgeKind> edgeKinds(const FieldWindow& window, const sdf::RayGrid& rays,
                                const SampledFacts& facts);

/// Of the film's crop, on a lattice of per_side^2 a pixel, whose rays end that much nearer to surfaces. On
/// the CPU.
std::vector<EdgeKind> edgeKindsOf(const MethodInput& input, int per_side);

}  // namespace edgewise::figures
