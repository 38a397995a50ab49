#include "pipeline/polygonize_within.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/error.h"
#include "sdf/field_scene.h"

namespace edgewise {
namespace {

constexpr int kLinesPerCell = 4;
/// Tries, and of the error what a next one asks for, of the one before.
constexpr int kTries = 4;
constexpr double kLess = 0.7;

[[noreturn]] void fail(const std::string& amount, const std::string& asked, const Polygonized& made,
                       const MeshDistance& distance) {
    const glm::dvec3& worst = distance.worst_on_surface;
    throw FailureError(
        asked, fmt::format("{} is not met: {} from mesh to surface, {} back (near {},{},{}), with "
                           "cells of {} divided {} times at most",
                           amount, distance.mesh_to_surface, distance.surface_to_mesh, worst.x, worst.y,
                           worst.z, made.lattice.step, sdf::kMostLevels));
}

/// Before all tries: it cannot be met.
[[noreturn]] void failSoon(const std::string& amount, const std::string& asked, const Polygonized& made,
                           const MeshDistance& distance) {
    const double needed = made.counts.bricks_needed;
    throw FailureError(
        asked, fmt::format("{} is not met: {} is reached with cells of {}, and smaller ones would {}", amount,
                           std::max(distance.mesh_to_surface, distance.surface_to_mesh), made.lattice.step,
                           std::isfinite(needed)
                               ? fmt::format("not fit into memory (at least {:.2g} bricks of them)", needed)
                               : fmt::format("have to be divided more than {} times", sdf::kMostLevels)));
}

}  // namespace

std::optional<MeshDistance> measuredDistance(const Polygonized& made, const Scene& scene,
                                             const sdf::MostOff* allowed) {
    if (made.points) return distanceOf(made.mesh, *made.points, made.lattice, kLinesPerCell, allowed);
    return distanceOf(made.mesh, sdf::lower(scene.field->tree), made.lattice, scene.field->bound_holds,
                      kLinesPerCell, allowed);
}

MeasuredMesh polygonizeWithin(const sdf::MostOff& most_off, const std::string& amount,
                              const std::string& asked, const Scene& scene, PolygonizeOptions options) {
    options.most_off = most_off;
    for (int n = 1;; ++n) {
        Polygonized made = polygonize(scene, options);
        enterStage(options, fmt::format("measure {} triangles", made.mesh.triangles.size()));
        const std::optional<MeshDistance> distance = measuredDistance(made, scene, &most_off);
        if (!distance) throw FailureError(asked, "this build has no CGAL to measure it with");
        if (distance->worst_part <= 1.0) return {std::move(made), *distance};
        if (made.counts.bricks_needed > 0.0) failSoon(amount, asked, made, *distance);
        if (n == kTries || options.resolution > sdf::kMostResolution / 2)
            fail(amount, asked, made, *distance);
        options.most_off = options.most_off->times(kLess);
        if (n > 1 || options.mesher != Mesher::kDual || made.points) options.resolution *= 2;
    }
}

}  // namespace edgewise
