#include "tests/witness/scene_builder.h"

#include <cmath>

#include "tests/witness/wide.h"

namespace edgewise::witness {
namespace {

Quad cross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (Quad(b.x) - a.x) * (Quad(c.y) - a.y) - (Quad(b.y) - a.y) * (Quad(c.x) - a.x);
}

}  // namespace

double toGrid(double px) {
    return std::nearbyint(px / kGridPx) * kGridPx;
}
glm::dvec2 toGrid(glm::dvec2 px) {
    return {toGrid(px.x), toGrid(px.y)};
}

int orientation(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    const Quad turn = cross(a, b, c);
    return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}

std::uint32_t SceneBuilder::addPlane(const DepthPlane& plane) {
    scene_.planes.push_back(plane);
    return std::uint32_t(scene_.planes.size() - 1);
}

std::uint32_t SceneBuilder::addPlane(const std::array<glm::dvec3, 3>& points) {
    const auto px = [&](int k) { return toGrid(glm::dvec2(points[k].x, points[k].y)); };
    const Quad area = cross(px(0), px(1), px(2));
    if (area == 0) return addPlane(DepthPlane{0, 0, points[0].z});
    const Quad x1 = Quad(px(1).x) - px(0).x, y1 = Quad(px(1).y) - px(0).y,
               z1 = Quad(points[1].z) - points[0].z;
    const Quad x2 = Quad(px(2).x) - px(0).x, y2 = Quad(px(2).y) - px(0).y,
               z2 = Quad(points[2].z) - points[0].z;
    const Quad dz_dx = (z1 * y2 - z2 * y1) / area, dz_dy = (x1 * z2 - x2 * z1) / area;
    const Quad z = points[0].z + dz_dx * (Quad(scene_.anchor_px.x) - px(0).x) +
                   dz_dy * (Quad(scene_.anchor_px.y) - px(0).y);
    return addPlane(DepthPlane{double(dz_dx), double(dz_dy), double(z)});
}

bool SceneBuilder::add(const std::array<glm::dvec3, 3>& points) {
    std::array<glm::dvec2, 3> p_px;
    for (int k = 0; k < 3; ++k) p_px[k] = toGrid(glm::dvec2(points[k].x, points[k].y));
    if (orientation(p_px[0], p_px[1], p_px[2]) == 0) return ++next_owner_, false;
    return addCorners(p_px, {points[0].z, points[1].z, points[2].z}, addPlane(points));
}

bool SceneBuilder::addOnPlane(const std::array<glm::dvec2, 3>& points_px, std::uint32_t plane) {
    std::array<glm::dvec2, 3> p_px;
    std::array<double, 3> depth;
    for (int k = 0; k < 3; ++k) {
        p_px[k] = toGrid(points_px[k]);
        depth[k] = depthAt(plane, p_px[k]);
    }
    return addCorners(p_px, depth, plane);
}

bool SceneBuilder::addCorners(const std::array<glm::dvec2, 3>& p_px, const std::array<double, 3>& depth,
                              std::uint32_t plane) {
    ScreenTriangle triangle{p_px, {}, next_owner_++, plane};
    const int turn = orientation(p_px[0], p_px[1], p_px[2]);
    if (turn == 0) return false;
    for (int k = 0; k < 3; ++k) triangle.vertex[k] = weld(p_px[k], depth[k]);
    if (turn < 0) {
        std::swap(triangle.p_px[1], triangle.p_px[2]);
        std::swap(triangle.vertex[1], triangle.vertex[2]);
    }
    scene_.triangles.push_back(triangle);
    return true;
}

std::uint32_t SceneBuilder::weld(glm::dvec2 p_px, double depth) {
    return welded_.try_emplace({p_px.x, p_px.y, depth}, std::uint32_t(welded_.size())).first->second;
}

double SceneBuilder::depthAt(std::uint32_t plane, glm::dvec2 p_px) const {
    const DepthPlane& z = scene_.planes[plane];
    return z.dz_dx * (p_px.x - scene_.anchor_px.x) + z.dz_dy * (p_px.y - scene_.anchor_px.y) + z.z_anchor;
}

}  // namespace edgewise::witness
