#include "pipeline/field_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/error.h"
#include "pipeline/field_parts.h"
#include "pipeline/film_footprint.h"
#include "pipeline/map_mesh_scene.h"
#include "pipeline/mesh_scene.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/polygonize_within.h"
#include "sdf/field_of_all.h"

namespace edgewise {
namespace {

/// Pixels around the film that count as seen: what prefilters reach, if they are no wider.
constexpr double kAroundPx = 16.0;
/// Of the way to what is seen: what is not may be off by so much, and stays unseen.
constexpr double kOfTheWay = 0.5;

class FilmMesher {
  public:
    FilmMesher(const std::string& method, MeshChoice choice, const MethodInput& in)
        : method_(method), choice_(std::move(choice)), in_(in), footprint_(in.camera, in.film) {
        if (isMap()) return;
        const glm::dvec3 eye(in.camera.camera.world_from_camera[3]);
        whole_ = sdf::fieldOfAll(*in.scene.field, eye);
        parts_ = partsOf(whole_);
        for (const HalfSpace& half : parts_.half_spaces)
            if (glm::dot(eye, half.normal_world) < half.offset)
                throw InputError(method, fmt::format("needs triangles, and the eye is within a plane's solid "
                                                     "half of '{}'; methods that trace it see it from within",
                                                     in.scene.source));
    }

    FieldMesh make(const MeshStore* store) {
        Stopwatch watch;
        const std::optional<FilmPolygons> kept = store ? store->find(choice_) : std::nullopt;
        if (kept)
            made_ = *kept;
        else if (isMap())
            meshWithin(in_.scene);
        else if (!parts_.rest.tree.empty())
            meshTree();
        if (!kept) made_.report.seconds = watch.lap();
        if (!kept && store) store->keep(choice_, made_);
        FieldMesh out;
        out.scene = isMap() ? mapMeshScene(in_, made_) : meshScene(in_, whole_, made_, parts_.half_spaces);
        out.report = made_.report;
        out.report.no_shadows = isMap() && losesShadows(*in_.scene.field);
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

    bool isMap() const { return in_.scene.field->glsl.has_value(); }

    void meshTree() {
        const sdf::Box bounds = sdf::levelBox(parts_.rest.tree, parts_.rest.tree.root);
        if (bounds.empty()) return;
        if (!bounds.bounded())
            throw InputError(method_, fmt::format("needs triangles, and '{}' is unbounded beside its planes; "
                                                  "polygonize --box --cap makes a mesh of a part",
                                                  in_.scene.source));
        meshWithin(restScene());
    }

    void meshWithin(const Scene& scene) {
        PolygonizeOptions options;
        options.mesher = parseMesher(choice_.mesher);
        options.resolution = kFirstResolution;
        options.progress = &in_.progress;
        MeasuredMesh measured =
            polygonizeWithin(allowed(), fmt::format("{} px", choice_.error_px), method_, scene, options);
        made_.mesh = std::move(measured.made.mesh);
        MeshReport& report = made_.report;
        report.mesher = choice_.mesher;
        report.cell_world = measured.made.lattice.step;
        report.mesh_to_surface = measured.distance.mesh_to_surface;
        report.surface_to_mesh = measured.distance.surface_to_mesh;
        report.error_px = choice_.error_px * measured.distance.worst_part;
        report.asked_px = choice_.error_px;
        report.pixel_world = closestPixel();
        report.triangles = made_.mesh.triangles.size();
    }

    /// What is seen by its own pixels; the rest may not come to be seen.
    sdf::MostOff allowed() const {
        const double around = std::max(kAroundPx, std::ceil(in_.filter.radius));
        return sdf::MostOff([this, around](const glm::dvec3& centre, double radius) {
            return std::max(choice_.error_px * footprint_.leastPixel(centre, radius),
                            kOfTheWay * (footprint_.awayFromView(centre, around) - radius));
        });
    }

    /// A pixel where the mesh is closest to the eye; 0: none of its corners is seen.
    double closestPixel() const {
        double closest = HUGE_VAL;
        for (const glm::dvec3& p : made_.mesh.position_world)
            if (footprint_.sees(p)) closest = std::min(closest, footprint_.pixelAt(p));
        return std::isfinite(closest) ? closest : 0.0;
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
    return FilmMesher(method, spec.mesh.value_or(MeshChoice{}), input).make(store);
}

std::string wordsOf(const MeshReport& report) {
    if (report.triangles == 0) return "polygonized: no surface, but for planes";
    return fmt::format(
        "polygonized by '{}': {} triangles, measured {:.3g} px off the surface of {} px allowed; {:.2f} s{}",
        report.mesher, report.triangles, report.error_px, report.asked_px, report.seconds,
        report.no_shadows ? "; lights throw no shadows on a mesh of raw GLSL" : "");
}

}  // namespace edgewise
