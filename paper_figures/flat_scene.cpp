#include "paper_figures/flat_scene.h"

namespace edgewise::figures {
namespace {

Geometry geometryOf(const FlatTriangle& triangle, std::uint32_t index, int side_px) {
    Geometry out;
    for (const glm::dvec2& p : triangle.p_px)
        out.position_file.emplace_back(float(p.x - 0.5 * side_px), float(0.5 * side_px - p.y),
                                       float(-triangle.depth));
    out.position_world.assign(out.position_file.begin(), out.position_file.end());
    out.world_from_file = glm::dmat4(1.0);
    out.triangles = {{0, 1, 2}};
    out.material = out.first_triangle = index;
    return out;
}

}  // namespace

Scene flatScene(std::span<const FlatTriangle> triangles, int side_px) {
    Scene scene;
    for (const FlatTriangle& triangle : triangles) {
        const auto index = static_cast<std::uint32_t>(scene.geometry.size());
        scene.geometry.push_back(geometryOf(triangle, index, side_px));
        Material& material = scene.materials.emplace_back();
        material.double_sided = material.unlit = true;
        material.base_color = glm::dvec4(triangle.color, 1.0);
    }
    scene.triangle_count = triangles.size();
    return scene;
}

ResolvedCamera flatCamera(int side_px) {
    ResolvedCamera camera;
    camera.camera.perspective = false;
    camera.camera.xmag = camera.camera.ymag = 0.5 * side_px;
    return camera;
}

}  // namespace edgewise::figures
