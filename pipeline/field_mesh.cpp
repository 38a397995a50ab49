#include "pipeline/field_mesh.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <mutex>

#include "pipeline/error.h"
#include "pipeline/field_parts.h"
#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/field_surface.h"
#include "pipeline/film_footprint.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/polygonize_within.h"
#include "sdf/evaluate.h"
#include "sdf/field_of_all.h"

namespace edgewise {
namespace {

/// Rays along the film's longer side that look for the closest surface.
constexpr int kScoutRays = 96;
/// What scouts miss may be closer by so much before the mesh is made again, for a smaller pixel.
constexpr double kScoutSlack = 1.05;
/// Corners of a half-space's disc: 3 times a power of 2. Its chords are off its circle by
/// radius (pi / n)^2 / 2, which is seen at the angle height / radius.
constexpr int kDiscCorners = 192;

/// Where the first triangles of a geometry come from; vertices with several normals are several.
class GeometryBuilder {
  public:
    void add(std::uint32_t vertex, const glm::dvec3& p_world, const glm::dvec3& normal_world) {
        const auto [found, is_new] =
            vertices_.try_emplace({vertex, {normal_world.x, normal_world.y, normal_world.z}},
                                  static_cast<std::uint32_t>(made.position_file.size()));
        corners_.push_back(found->second);
        if (is_new) {
            made.position_file.emplace_back(p_world);
            // What a file would hold: the scene is the same as the mesh that polygonize writes.
            made.position_world.emplace_back(made.position_file.back());
            made.normal_world.push_back(normal_world);
        }
        if (corners_.size() < 3) return;
        made.triangles.push_back({corners_[0], corners_[1], corners_[2]});
        corners_.clear();
    }

    Geometry made;

  private:
    std::map<std::pair<std::uint32_t, std::array<double, 3>>, std::uint32_t> vertices_;
    std::vector<std::uint32_t> corners_;
};

/// What is looked for and where, in words for errors.
class FilmMesher {
  public:
    FilmMesher(const std::string& method, MeshChoice choice, const MethodInput& in)
        : method_(method), choice_(std::move(choice)), in_(in), footprint_(in.camera, in.film) {
        eye_world_ = glm::dvec3(in.camera.camera.world_from_camera[3]);
        whole_ = sdf::fieldOfAll(*in.scene.field, eye_world_);
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
        out_.report = made_.report;
        build();
        out_.report.seconds += watch.lap();
        return std::move(out_);
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

    void build() {
        sdf::ShadingSettings shading = shadingOf(whole_, {});
        shading.background = in_.options.background;
        if (whole_.lights.empty()) addDefaultRig(in_.camera, shading);
        surface_ = std::make_shared<FieldSurface>(
            whole_, std::move(shading), rayGrid(in_.camera, in_.film, whole_.far),
            std::max(out_.report.mesh_to_surface, out_.report.surface_to_mesh));
        Scene& scene = out_.scene;
        const Scene& from = in_.scene;
        scene.source = from.source;
        scene.cameras = from.cameras, scene.lights = from.lights;
        scene.bounds_min = from.bounds_min, scene.bounds_max = from.bounds_max;
        const bool inside = surface_->tracer().signAt(eye_world_) < 0.0;
        for (const sdf::SurfaceMaterial& material : whole_.materials) {
            Material& made = scene.materials.emplace_back();
            made.name = material.name;
            made.base_color = glm::dvec4(material.color, 1.0);
            made.double_sided = inside;
        }
        addMesh();
        for (const HalfSpace& half : parts_.half_spaces) addDisc(half);
        scene.point_shader = surface_;
    }

    void addMesh() {
        const sdf::SurfaceMesh& mesh = made_.mesh;
        std::vector<TriangleLook> looks(mesh.triangles.size());
        tbb::parallel_for(std::size_t(0), looks.size(), [&](std::size_t t) {
            glm::dvec3 corners[3];
            for (int i = 0; i < 3; ++i) corners[i] = mesh.position_world[mesh.triangles[t][i]];
            looks[t] = surface_->lookOf(corners);
        });
        for (std::uint32_t material = 0; material < out_.scene.materials.size(); ++material) {
            GeometryBuilder geometry;
            for (std::size_t t = 0; t < looks.size(); ++t) {
                if (looks[t].material != material) continue;
                for (int i = 0; i < 3; ++i)
                    geometry.add(mesh.triangles[t][i], mesh.position_world[mesh.triangles[t][i]],
                                 mesh.normal_world[t][i]);
                surface_->add(looks[t]);
            }
            addGeometry(std::move(geometry.made), material, "surface");
        }
    }

    /// A place of the disc where nothing covers it, so that its own shape wins there; its rim's first corner
    /// where there is none.
    template <class Rim>
    glm::dvec3 placeOnSurface(const glm::dvec3& foot, const Rim& rim) const {
        for (double part = 1.0; part > 1e-4; part *= 0.7)
            for (int corner = 0; corner < kDiscCorners; corner += 8) {
                const glm::dvec3 p = glm::mix(foot, rim(corner), part);
                const double value = sdf::valueAt(surface_->tape(), p);
                if (std::abs(value) <= 1e-12 * (glm::length(p) + whole_.far)) return p;
            }
        return rim(0);
    }

    /// Where rays that meet the half-space's border end. Nothing is seen of it from within.
    void addDisc(const HalfSpace& half) {
        const glm::dvec3& n = half.normal_world;
        const double height = glm::dot(eye_world_, n) - half.offset;
        if (!(height > 0.0) || height >= whole_.far) return;
        const double radius = std::sqrt(whole_.far * whole_.far - height * height);
        const glm::dvec3 foot = eye_world_ - height * n;
        const glm::dvec3 u =
            glm::normalize(glm::cross(n, std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dvec3 v = glm::cross(n, u);
        const auto rim = [&](int corner) {
            const double angle = 2.0 * glm::pi<double>() * corner / kDiscCorners;
            return foot + radius * (std::cos(angle) * u + std::sin(angle) * v);
        };
        const TriangleLook look = surface_->lookAt(placeOnSurface(foot, rim));
        GeometryBuilder geometry;
        const auto triangle = [&](int a, int b, int c) {
            for (const int corner : {a, b, c}) geometry.add(std::uint32_t(corner), rim(corner), n);
            surface_->add(look);
        };
        const int third = kDiscCorners / 3;
        triangle(0, third, 2 * third);
        for (int step = third; step > 1; step /= 2)
            for (int a = 0; a < kDiscCorners; a += step) triangle(a, a + step / 2, (a + step) % kDiscCorners);
        addGeometry(std::move(geometry.made), look.material, "plane");
    }

    void addGeometry(Geometry geometry, std::uint32_t material, const char* name) {
        if (geometry.triangles.empty()) return;
        Scene& scene = out_.scene;
        geometry.material = material;
        geometry.world_from_file = glm::dmat4(1.0);
        geometry.node = geometry.mesh = static_cast<std::uint32_t>(scene.node_names.size());
        geometry.first_triangle = static_cast<std::uint32_t>(scene.triangle_count);
        scene.triangle_count += geometry.triangles.size();
        scene.node_names.emplace_back(name), scene.mesh_names.emplace_back(name);
        scene.geometry.push_back(std::move(geometry));
    }

    const std::string& method_;
    const MeshChoice choice_;
    const MethodInput& in_;
    const FilmFootprint footprint_;
    glm::dvec3 eye_world_;
    sdf::FieldScene whole_;
    FieldParts parts_;
    FilmPolygons made_;
    std::shared_ptr<FieldSurface> surface_;
    FieldMesh out_;
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
