// Meshes whose measured distance from the surface is below a bound.
#pragma once

#include <optional>
#include <string>

#include "pipeline/judge/mesh_quality.h"
#include "pipeline/polygonize.h"

namespace edgewise {

/// Cells along the box's longest side that it begins with, where nobody says.
inline constexpr int kFirstResolution = 64;

/// None in a build without CGAL.
std::optional<MeshDistance> measuredDistance(const Polygonized& made, const Scene& scene,
                                             const sdf::MostOff* allowed = nullptr);

struct MeasuredMesh {
    Polygonized made;
    MeshDistance distance;
};

/// Asks for less each time, with smaller cells at last, until what is measured is within what is allowed.
/// `amount`: most_off in words. Throws FailureError naming `asked` where that is not reached, and in a build
/// that cannot measure it.
MeasuredMesh polygonizeWithin(const sdf::MostOff& most_off, const std::string& amount,
                              const std::string& asked, const Scene& scene, PolygonizeOptions options);

}  // namespace edgewise
