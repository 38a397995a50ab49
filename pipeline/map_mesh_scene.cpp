#include "pipeline/map_mesh_scene.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/geometry_builder.h"
#include "pipeline/point_shader.h"
#include "sdf/shader.h"

namespace edgewise {
namespace {

class NothingElse : public sdf::SurfaceTracer {
  public:
    sdf::SurfaceHit nearest(const sdf::FieldRay&, double) const override { return {}; }
    bool occluded(const sdf::FieldRay&, double, std::uint64_t&) const override { return false; }
};

/// Of the point p in the triangle's plane.
glm::dvec3 barycentric(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double area = glm::dot(n, n);
    if (!(area > 0.0)) return {1.0, 0.0, 0.0};
    const double u = glm::dot(n, glm::cross(c - b, p - b)) / area,
                 v = glm::dot(n, glm::cross(a - c, p - c)) / area;
    return {u, v, 1.0 - u - v};
}

class MapSurface : public PointShader {
  public:
    MapSurface(sdf::ShadingSettings shading, const sdf::RayGrid& grid, const sdf::SurfaceMesh& mesh)
        : grid_(grid),
          mesh_(mesh),
          material_(static_cast<std::uint32_t>(shading.materials.size() - 1)),
          shader_(std::move(shading), nothing_else_) {}

    glm::dvec3 color(const SeenPoint& point) const override {
        sdf::SurfaceHit hit;
        hit.hit = true, hit.inside = point.back_facing;
        hit.p_world = hit.p_local = point.p_world;
        hit.normal_world = point.back_facing ? -point.normal_world : point.normal_world;
        hit.material = material_;
        if (!mesh_.color.empty()) hit.color = colorAt(point);
        const sdf::FieldRay ray = rayTowards(grid_, point.p_world, hit.t);
        sdf::RayCounts counts;
        return glm::dvec3(shader_.shade(ray, hit, counts, point.back_facing ? -1.0 : 1.0));
    }

  private:
    glm::dvec3 colorAt(const SeenPoint& point) const {
        const sdf::Triangle& t = mesh_.triangles[point.triangle];
        const auto& p = mesh_.position_world;
        const glm::dvec3 part = barycentric(p[t[0]], p[t[1]], p[t[2]], point.p_world);
        const auto& corner = mesh_.color[point.triangle];
        return glm::clamp(part.x * corner[0] + part.y * corner[1] + part.z * corner[2], 0.0, 1.0);
    }

    const sdf::RayGrid grid_;
    const sdf::SurfaceMesh mesh_;
    const std::uint32_t material_;
    const NothingElse nothing_else_;
    const sdf::Shader shader_;
};

}  // namespace

Scene mapMeshScene(const MethodInput& in, const FilmPolygons& polygons) {
    const sdf::FieldScene& map = *in.scene.field;
    const sdf::SurfaceMesh& mesh = polygons.mesh;
    Scene scene;
    scene.source = in.scene.source;
    scene.cameras = in.scene.cameras, scene.lights = in.scene.lights;
    scene.bounds_min = in.scene.bounds_min, scene.bounds_max = in.scene.bounds_max;
    Material& material = scene.materials.emplace_back();
    material.name = map.materials.back().name;
    material.base_color = glm::dvec4(map.materials.back().color, 1.0);
    material.double_sided = true;  // the eye may be within the solid
    GeometryBuilder geometry;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            geometry.add(mesh.triangles[t][i], mesh.position_world[mesh.triangles[t][i]],
                         mesh.normal_world[t][i]);
    addGeometry(scene, std::move(geometry.made), 0, "surface");
    scene.point_shader =
        std::make_shared<MapSurface>(fieldShading(in, {}, false), rayGrid(in.camera, in.film, map.far), mesh);
    return scene;
}

bool losesShadows(const sdf::FieldScene& map) {
    return std::ranges::any_of(map.lights, [](const sdf::SurfaceLight& light) { return light.shadows; });
}

}  // namespace edgewise
