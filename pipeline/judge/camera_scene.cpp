#include "pipeline/judge/camera_scene.h"

#include "pipeline/judge/projection_witness.h"
#include "pipeline/project.h"
#include "pipeline/resolve_camera.h"

namespace edgewise::judge {
namespace {

constexpr double kYfov = 1.5707963267948966;

Scene sceneOf(const std::vector<WorldTriangle>& triangles, const CameraView& view) {
    Geometry geometry;
    for (const WorldTriangle& triangle : triangles) {
        const auto first = static_cast<std::uint32_t>(geometry.position_file.size());
        geometry.triangles.push_back({first, first + 1, first + 2});
        for (const glm::vec3& p : triangle) {
            geometry.position_file.push_back(p);
            geometry.position_world.emplace_back(p);
        }
    }
    geometry.world_from_file = glm::dmat4(1.0);
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].double_sided = true;
    scene.geometry = {geometry};
    scene.triangle_count = triangles.size();
    Camera camera;
    camera.world_from_camera = view.world_from_camera;
    camera.yfov = kYfov, camera.znear = view.znear;
    scene.cameras = {camera};
    return scene;
}

}  // namespace

glm::vec3 CameraView::toWorld(const glm::dvec3& p_eye) const {
    return glm::vec3(glm::dvec3(world_from_camera * glm::dvec4(p_eye, 1.0)));
}

glm::dvec3 CameraView::seenAt(glm::dvec2 from_sample_px, double w) const {
    const double per_px = 2.0 / (2 * pixel.y + 1);  // the tangent of 45 degrees over half the film
    return {from_sample_px.x * per_px * w, -from_sample_px.y * per_px * w, -w};
}

StiffScene throughCamera(const std::vector<WorldTriangle>& triangles, const CameraView& view) {
    const Scene scene = sceneOf(triangles, view);
    CameraOptions options;
    options.size = 2 * view.pixel + 1;
    Film film;
    const ResolvedCamera camera = resolveCamera(scene, options, film);
    ScreenPieces pieces;
    StiffScene stiff{project(scene, camera, film, pieces), view.pixel, {}};
    stiff.projection = judgeProjection(triangles, camera, film, stiff.scene, pieces);
    return stiff;
}

}  // namespace edgewise::judge
