#include "pipeline/field_rays.h"

#include <algorithm>

#include "pipeline/lighting.h"
#include "pipeline/screen_map.h"

namespace edgewise {

sdf::RayGrid rayGrid(const ResolvedCamera& camera, const Film& film, double far) {
    const ScreenMap map = makeScreenMap(camera, film);
    const glm::dvec2 principal = map.whole_px + map.fraction_px + map.offset_px;
    const glm::dmat4& world = camera.camera.world_from_camera;
    const glm::dmat3 turn(world);
    sdf::RayGrid grid;
    grid.perspective = map.perspective;
    grid.eye_world = glm::dvec3(world[3]);
    grid.axis_world = glm::normalize(-turn[2]);
    grid.right_world = turn[0] / map.scale_px;
    grid.down_world = -turn[1] / map.scale_px;
    grid.corner_world = -principal.x * grid.right_world - principal.y * grid.down_world;
    grid.corner_world += map.perspective ? grid.axis_world : grid.eye_world;
    grid.t_min = camera.camera.znear;
    grid.t_max = std::min(far, camera.camera.zfar.value_or(far));
    return grid;
}

sdf::FieldRay rayTowards(const sdf::RayGrid& grid, const glm::dvec3& p_world, double& t) {
    sdf::FieldRay ray = grid.ray(glm::dvec2(0.0));
    if (grid.perspective) {
        t = glm::distance(p_world, grid.eye_world);
        ray.direction_world = (p_world - grid.eye_world) / t;
        return ray;
    }
    t = glm::dot(p_world - ray.origin_world, ray.direction_world);
    ray.origin_world = p_world - t * ray.direction_world;
    return ray;
}

double signOfView(const sdf::SceneTracer& scene, const sdf::RayGrid& grid, const Film& film) {
    if (grid.perspective) return scene.signAt(grid.eye_world);
    constexpr int kPlaces = 4;  // and one more along each side
    for (int y = 0; y <= kPlaces; ++y)
        for (int x = 0; x <= kPlaces; ++x) {
            const glm::dvec2 part = glm::dvec2(x, y) / double(kPlaces);
            const sdf::FieldRay ray = grid.ray(part * glm::dvec2(film.width, film.height));
            if (scene.signAt(ray.origin_world + ray.direction_world * ray.t_min) > 0.0) return 1.0;
        }
    return -1.0;
}

void addDefaultRig(const ResolvedCamera& camera, sdf::ShadingSettings& settings) {
    const glm::dmat3 turn(camera.camera.world_from_camera);
    settings.ambient += glm::dvec3(kRigAmbient);
    for (const RigLight& lamp : {kRigKey, kRigFill}) {
        sdf::SurfaceLight light;
        light.direction_world = -(turn * lamp.towards);
        light.intensity = 3.14159265358979323846 * lamp.intensity;
        light.shadows = false;
        settings.lights.push_back(light);
    }
}

}  // namespace edgewise
