#include "pipeline/polygonize.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <ctime>

#include "pipeline/cgal_mesher.h"
#include "pipeline/error.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/polygonize_map.h"
#include "sdf/field_scene.h"
#include "sdf/scene_error.h"

namespace edgewise {
namespace {

/// Of the bounds' longest side, how much further the default box reaches.
constexpr double kMargin = 0.02;
/// Bytes that a brick with surface takes in all, triangles and their checks included; measured on gyroids.
constexpr double kBytesPerBrick = 60000.0;

const sdf::FieldScene& fieldOf(const Scene& scene) {
    if (!scene.field) throw InputError(scene.source, "is no SDF scene");
    return *scene.field;
}

WorldBox boxOf(const Scene& scene) {
    const sdf::FieldScene& field = *scene.field;
    const sdf::Box bounds = sdf::levelBox(field.tree, field.tree.root);
    if (bounds.empty()) throw InputError(scene.source, "holds no surface");
    if (!bounds.bounded())
        throw InputError(scene.source,
                         "its tree is unbounded, a mesh of it needs --box X0,Y0,Z0,X1,Y1,Z1, and --cap where "
                         "it goes on beyond");
    WorldBox box;
    for (int axis = 0; axis < 3; ++axis) box.low[axis] = bounds.low[axis], box.high[axis] = bounds.high[axis];
    return withMargin(box);
}

double cpuSeconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A surface passes at least about one brick a square of a brick's face: what is refused could not fit.
double machineBytes() {
    return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace

void enterStage(const PolygonizeOptions& options, std::string_view name) {
    if (!options.progress) return;
    options.progress->stage(name, 0);
    checkCancelled(*options.progress);
}

WorldBox withMargin(const WorldBox& box) {
    const glm::dvec3 size = box.high - box.low;
    const double margin = kMargin * std::max({size.x, size.y, size.z, 1e-9});
    return {box.low - margin, box.high + margin};
}

void requireMeshMemory(const sdf::Lattice& lattice) {
    const glm::dvec3 bricks(lattice.bricks());
    const double needed = kBytesPerBrick * (bricks.x * bricks.y + bricks.y * bricks.z + bricks.z * bricks.x) +
                          4.0 * bricks.x * bricks.y * bricks.z;
    const double machine = machineBytes();
    if (needed > machine)
        throw FailureError(
            "memory", fmt::format("a mesh of {}x{}x{} cells may need {:.0f} MiB, this machine has {:.0f}",
                                  lattice.cells.x, lattice.cells.y, lattice.cells.z, needed / 0x1p20,
                                  machine / 0x1p20));
}

Mesher parseMesher(const std::string& name) {
    if (name == "dual") return Mesher::kDual;
    if (name == "marching-cubes") return Mesher::kMarchingCubes;
    if (name == "cgal") return Mesher::kCgal;
    throw InputError("--mesher", fmt::format("'{}' is none of dual, marching-cubes, cgal", name));
}

Scene cappedAt(const Scene& scene, const WorldBox& box) {
    sdf::FieldScene field = fieldOf(scene);
    const glm::dvec3 middle = 0.5 * (box.low + box.high), size = box.high - box.low;
    const std::uint32_t solid = field.tree.root;
    const std::uint32_t cap = field.tree.add(sdf::Kind::kBox, {size.x, size.y, size.z});
    const std::uint32_t moved = field.tree.add(sdf::Kind::kTranslate, {middle.x, middle.y, middle.z}, {cap});
    field.tree.root = field.tree.add(sdf::Kind::kIntersection, {}, {solid, moved});
    Scene capped = scene;
    capped.field = std::make_shared<sdf::FieldScene>(std::move(field));
    return capped;
}

namespace {

Polygonized polygonizeTree(const Scene& scene, const PolygonizeOptions& options) {
    const sdf::FieldScene& field = *scene.field;
    const WorldBox box = options.box ? *options.box : boxOf(scene);
    Polygonized result;
    result.lattice = sdf::latticeOf(box.low, box.high, options.resolution);
    requireMeshMemory(result.lattice);
    try {
        const sdf::Tape tape = sdf::lower(field.tree);
        sdf::MeshRequest request{tape, result.lattice, field.bound_holds};
        request.most_off = options.most_off;
        request.most_bricks = static_cast<std::size_t>(0.5 * machineBytes() / kBytesPerBrick);
        switch (options.mesher) {
            case Mesher::kDual:
                result.mesh = sdf::dualContouring(request, result.counts);
                break;
            case Mesher::kMarchingCubes:
                result.mesh = sdf::marchingCubes(request, result.counts);
                break;
            case Mesher::kCgal:
                result.mesh = cgalMesh(request, scene.source, result.counts);
        }
    } catch (const sdf::SceneError& error) {
        throw InputError(scene.source, error.what());
    }
    return result;
}

}  // namespace

Polygonized polygonize(const Scene& scene, const PolygonizeOptions& options) {
    const sdf::FieldScene& field = fieldOf(scene);
    enterStage(options, fmt::format("polygonize, {} cells a side", options.resolution));
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = cpuSeconds();
    Polygonized result = field.tree.empty() ? polygonizeMap(scene, options) : polygonizeTree(scene, options);
    result.cpu_seconds = cpuSeconds() - cpu_start;
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (result.mesh.triangles.empty())
        throw InputError(scene.source,
                         "no surface was found in the box: it is empty there, or finer than a cell");
    return result;
}

}  // namespace edgewise
