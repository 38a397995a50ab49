#include "pipeline/field_mesh.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "pipeline/error.h"
#include "pipeline/field_parts.h"
#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/film_footprint.h"
#include "pipeline/mesh_scene.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/polygonize_within.h"
#include "sdf/field_of_all.h"
#include "sdf/scene_trace.h"

namespace edgewise {
namespace {

/// Rays along the film's longer side that look for the closest surface.
constexpr int kScoutRays = 96;
/// What scouts miss may be closer by so much before the mesh is made again, for a smaller pixel.
constexpr double kScoutSlack = 1.05;
/// Finds the size of a pixel and makes the mesh for it.
class FilmMesher {
  public:
    FilmMesher(const std::string& method, MeshChoice choice, const MethodInput& in)
        : method_(method), choice_(std::move(choice)), in_(in), footprint_(in.camera, in.film) {
        whole_ = sdf::fieldOfAll(*in.scene.field, glm::dvec3(in.camera.camera.world_from_camera[3]));
        parts_ = partsOf(whole_);
    }

    FieldMesh make(const MeshStore* store) {
        Stopwatch watch;
        const std::optional<FilmPolygons> kept = store ? store->find(choice_) : std::nullopt;
        if (kept)
            made_ = *kept;
        else if (!parts_.rest.tree.empty())
            meshWithin();
        if (!kept) made_.report.seconds = watch.lap();
        if (!kept && store) store->keep(choice_, made_);
        FieldMesh out;
        out.scene = meshScene(in_, whole_, made_, parts_.half_spaces);
        out.report = made_.report;
        out.report.seconds += watch.lap();
        return out;
    }

  private:
    Scene restScene() const {
        Scene scene;
        scene.source = in_.scene.source;
        scene.field = std::make_shared<sdf::FieldScene>(parts_.rest);
        return scene;
    }

    void meshWithin() {
        const sdf::Box bounds = sdf::levelBox(parts_.rest.tree, parts_.rest.tree.root);
        if (!bounds.empty() && !bounds.bounded())
            throw InputError(method_, fmt::format("needs triangles, and '{}' is unbounded beside its planes; "
                                                  "polygonize --box --cap makes a mesh of a part",
                                                  in_.scene.source));
        const Scene scene = restScene();
        double pixel = closestScouted();
        meshFor(pixel, scene);
        const double closest = closestOfMesh();
        if (std::isfinite(closest) && closest * kScoutSlack < pixel) meshFor(pixel = closest, scene);
        MeshReport& report = made_.report;
        report.pixel_world = std::isfinite(closest) ? std::min(closest, pixel) : pixel;
        report.triangles = made_.mesh.triangles.size();
    }

    void meshFor(double pixel, const Scene& scene) {
        MeshReport& report = made_.report;
        PolygonizeOptions options;
        options.mesher = parseMesher(choice_.mesher);
        options.resolution = kFirstResolution;
        report.mesher = choice_.mesher;
        report.asked_world = choice_.error_px * pixel;
        in_.progress.stage("polygonize", 0);
        MeasuredMesh measured = polygonizeWithin(report.asked_world, method_, scene, options,
                                                 [this] { checkCancelled(in_.progress); });
        made_.mesh = std::move(measured.made.mesh);
        report.cell_world = measured.made.lattice.step;
        report.mesh_to_surface = measured.distance.mesh_to_surface;
        report.surface_to_mesh = measured.distance.surface_to_mesh;
    }

    /// Where a coarse lattice of rays meets the rest; where none does, the closest corner of its bounds that
    /// the film may see.
    double closestScouted() const {
        const sdf::Tape tape = loweredTree(parts_.rest);
        const sdf::SceneTracer tracer(parts_.rest, tape, trustedSettings(parts_.rest, {}));
        const sdf::RayGrid grid = rayGrid(in_.camera, in_.film, parts_.rest.far);
        const double sign = grid.perspective ? tracer.signAt(grid.eye_world) : 1.0;
        const double step = std::max(in_.film.width, in_.film.height) / double(kScoutRays);
        const int rows = std::max(1, static_cast<int>(in_.film.height / step)),
                  columns = std::max(1, static_cast<int>(in_.film.width / step));
        double closest = HUGE_VAL;
        std::mutex mutex;
        tbb::parallel_for(0, rows, [&](int row) {
            double least = HUGE_VAL;
            for (int column = 0; column < columns; ++column) {
                const sdf::FieldRay ray = grid.ray(
                    {(column + 0.5) * in_.film.width / columns, (row + 0.5) * in_.film.height / rows});
                const sdf::SurfaceHit hit = tracer.nearest(ray, sign);
                if (hit.hit) least = std::min(least, footprint_.pixelAt(hit.p_world));
            }
            const std::lock_guard lock(mutex);
            closest = std::min(closest, least);
        });
        return std::isfinite(closest) ? closest : closestOfBounds();
    }

    double closestOfBounds() const {
        const sdf::Box box = sdf::levelBox(parts_.rest.tree, parts_.rest.tree.root);
        const glm::dvec3 low(box.low[0], box.low[1], box.low[2]), high(box.high[0], box.high[1], box.high[2]);
        const double pixel = footprint_.pixelAt(0.5 * (low + high));
        const glm::dvec3 size = high - low;
        return std::isfinite(pixel) ? pixel : std::max({size.x, size.y, size.z}) / kScoutRays;
    }

    double closestOfMesh() const {
        double closest = HUGE_VAL;
        for (const glm::dvec3& p : made_.mesh.position_world)
            if (footprint_.sees(p)) closest = std::min(closest, footprint_.pixelAt(p));
        return closest;
    }

    const std::string& method_;
    const MeshChoice choice_;
    const MethodInput& in_;
    const FilmFootprint footprint_;
    sdf::FieldScene whole_;
    FieldParts parts_;
    FilmPolygons made_;
};

}  // namespace

FieldMesh meshForFilm(const MethodSpec& spec, const MethodInput& input, const MeshStore* store) {
    const std::string method = fmt::format("method '{}'", spec.typed);
    if (input.scene.field->tree.empty() && input.scene.field->glsl)
        throw InputError(method, fmt::format("needs triangles, and '{}' is GLSL, which is not polygonized",
                                             input.scene.source));
    return FilmMesher(method, spec.mesh.value_or(MeshChoice{}), input).make(store);
}

std::string wordsOf(const MeshReport& report) {
    if (report.triangles == 0) return "polygonized: planes alone";
    return fmt::format(
        "polygonized by '{}': {} triangles, measured {:.3g} and {:.3g} off the surface, {:.3g} px where that "
        "is closest; {:.2f} s",
        report.mesher, report.triangles, report.mesh_to_surface, report.surface_to_mesh, report.errorPx(),
        report.seconds);
}

}  // namespace edgewise
