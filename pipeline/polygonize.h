// Meshes of SDF scenes.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/progress.h"
#include "pipeline/scene.h"
#include "sdf/point_field.h"
#include "sdf/polygonize.h"

namespace edgewise {

enum class Mesher { kMarchingCubes, kDual, kCgal };
/// Throws InputError naming those that there are.
Mesher parseMesher(const std::string& name);

struct WorldBox {
    glm::dvec3 low{0.0}, high{0.0};
};

struct PolygonizeOptions {
    Mesher mesher = Mesher::kDual;
    int resolution = 128;  ///< cells along the box's longest side
    std::optional<WorldBox>
        box;  ///< where the surface is looked for; none: the scene's bounds and a little more
    std::optional<sdf::MostOff>
        most_off;      ///< how far mesh and surface may be apart; dual contouring of a tree divides for it
    bool cap = false;  ///< of raw GLSL: what is within the box alone, as cappedAt() has of trees
    Progress* progress = nullptr;  ///< told of stages; asked whether to stop, between batches of raw GLSL
};

struct Polygonized {
    sdf::SurfaceMesh mesh;
    sdf::Lattice lattice;
    sdf::MeshCounts counts;
    double seconds = 0.0, cpu_seconds = 0.0;
    std::shared_ptr<const sdf::PointField> points;  ///< of raw GLSL: what was meshed
    std::vector<std::string> notes;                 ///< one sentence each
};

/// Tells of a stage without end in sight, if anybody asks; throws Interrupted where they want no more.
void enterStage(const PolygonizeOptions& options, std::string_view name);

/// The box and a little more around it.
WorldBox withMargin(const WorldBox& box);

/// Throws FailureError where no mesh in the lattice could fit into memory.
void requireMeshMemory(const sdf::Lattice& lattice);

/// A tree's solid within the box alone, closed where the box cuts it; what it gets there has no material of
/// its own.
Scene cappedAt(const Scene& scene, const WorldBox& box);

/// Throws InputError naming the scene: it is no SDF scene, is unbounded and has no box, is empty,
/// reaches the box's end; FailureError where the mesh would not fit into memory.
Polygonized polygonize(const Scene& scene, const PolygonizeOptions& options);

}  // namespace edgewise
