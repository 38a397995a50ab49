#include "pipeline/mesh_scene.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <memory>

#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/field_surface.h"
#include "pipeline/geometry_builder.h"
#include "sdf/evaluate.h"

namespace edgewise {
namespace {

/// Corners of a half-space's disc: 3 times a power of 2. Its chords are off its circle by
/// radius (pi / n)^2 / 2, which is seen at the angle height / radius.
constexpr int kDiscCorners = 192;

class MeshScene {
  public:
    MeshScene(const MethodInput& in, const sdf::FieldScene& whole, const FilmPolygons& polygons,
              std::span<const HalfSpace> half_spaces)
        : in_(in),
          whole_(whole),
          polygons_(polygons),
          half_spaces_(half_spaces),
          eye_world_(in.camera.camera.world_from_camera[3]),
          surface_(surface()) {}

    Scene make() {
        const Scene& from = in_.scene;
        scene_.source = from.source;
        scene_.cameras = from.cameras, scene_.lights = from.lights;
        scene_.bounds_min = from.bounds_min, scene_.bounds_max = from.bounds_max;
        const bool inside = surface_->tracer().signAt(eye_world_) < 0.0;
        for (const sdf::SurfaceMaterial& material : whole_.materials) {
            Material& made = scene_.materials.emplace_back();
            made.name = material.name;
            made.base_color = glm::dvec4(material.color, 1.0);
            made.double_sided = inside;
        }
        addMesh();
        for (const HalfSpace& half : half_spaces_) addDisc(half);
        scene_.point_shader = surface_;
        return std::move(scene_);
    }

  private:
    std::shared_ptr<FieldSurface> surface() const {
        sdf::ShadingSettings shading = shadingOf(whole_, {});
        shading.background = in_.options.background;
        if (whole_.lights.empty()) addDefaultRig(in_.camera, shading);
        return std::make_shared<FieldSurface>(whole_, std::move(shading),
                                              rayGrid(in_.camera, in_.film, whole_.far),
                                              FilmFootprint(in_.camera, in_.film), polygons_.report.error_px);
    }

    void addMesh() {
        const sdf::SurfaceMesh& mesh = polygons_.mesh;
        std::vector<TriangleLook> looks(mesh.triangles.size());
        tbb::parallel_for(std::size_t(0), looks.size(), [&](std::size_t t) {
            glm::dvec3 corners[3];
            for (int i = 0; i < 3; ++i) corners[i] = mesh.position_world[mesh.triangles[t][i]];
            looks[t] = surface_->lookOf(corners);
        });
        for (std::uint32_t material = 0; material < scene_.materials.size(); ++material) {
            GeometryBuilder geometry;
            for (std::size_t t = 0; t < looks.size(); ++t) {
                if (looks[t].material != material) continue;
                for (int i = 0; i < 3; ++i)
                    geometry.add(mesh.triangles[t][i], mesh.position_world[mesh.triangles[t][i]],
                                 mesh.normal_world[t][i]);
                surface_->add(looks[t]);
            }
            addGeometry(scene_, std::move(geometry.made), material, "surface");
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
        addGeometry(scene_, std::move(geometry.made), look.material, "plane");
    }

    const MethodInput& in_;
    const sdf::FieldScene& whole_;
    const FilmPolygons& polygons_;
    const std::span<const HalfSpace> half_spaces_;
    const glm::dvec3 eye_world_;
    const std::shared_ptr<FieldSurface> surface_;
    Scene scene_;
};

}  // namespace

Scene meshScene(const MethodInput& input, const sdf::FieldScene& field, const FilmPolygons& polygons,
                std::span<const HalfSpace> half_spaces) {
    return MeshScene(input, field, polygons, half_spaces).make();
}

}  // namespace edgewise
