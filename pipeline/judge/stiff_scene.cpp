#include "pipeline/judge/stiff_scene.h"

#include <algorithm>
#include <cmath>

namespace edgewise::judge {
namespace {

/// The plane through three corners, in long double: its rounding is part of the scene, not of what is judged.
DepthPlane planeThrough(const std::array<glm::dvec3, 3>& c, glm::dvec2 anchor) {
    using Wide = long double;
    const Wide x1 = Wide(c[1].x) - c[0].x, y1 = Wide(c[1].y) - c[0].y, z1 = Wide(c[1].z) - c[0].z;
    const Wide x2 = Wide(c[2].x) - c[0].x, y2 = Wide(c[2].y) - c[0].y, z2 = Wide(c[2].z) - c[0].z;
    const Wide area = x1 * y2 - x2 * y1;
    if (area == 0) return {0.0, 0.0, c[0].z};
    const Wide a = (z1 * y2 - z2 * y1) / area, b = (x1 * z2 - x2 * z1) / area;
    return {static_cast<double>(a), static_cast<double>(b),
            static_cast<double>(c[0].z + a * (Wide(anchor.x) - c[0].x) + b * (Wide(anchor.y) - c[0].y))};
}

/// Exact for grid points: both products have at most 106 bits, and a fused one shows the rest of the other.
int orientation(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    const glm::dvec2 u = b - a, v = c - a;
    const double p = u.x * v.y, q = u.y * v.x;
    if (p != q) return p > q ? 1 : -1;
    const double rest = std::fma(u.x, v.y, -p) - std::fma(u.y, v.x, -q);
    return rest > 0.0 ? 1 : rest < 0.0 ? -1 : 0;
}

}  // namespace

glm::dvec2 toGrid(glm::dvec2 px) {
    return {std::nearbyint(px.x / kGridPx) * kGridPx, std::nearbyint(px.y / kGridPx) * kGridPx};
}

void StiffSceneBuilder::add(const std::array<glm::dvec3, 3>& corners) {
    std::array<glm::dvec3, 3> on_grid;
    std::array<glm::dvec2, 3> px;
    for (std::size_t k = 0; k < 3; ++k) {
        px[k] = toGrid(glm::dvec2(corners[k]));
        on_grid[k] = glm::dvec3(px[k], corners[k].z);
    }
    add(px, planeThrough(on_grid, scene_.anchor_px));
}

void StiffSceneBuilder::add(const std::array<glm::dvec2, 3>& corners, const DepthPlane& plane) {
    const auto known = std::ranges::find_if(scene_.planes, [&](const DepthPlane& p) {
        return p.dz_dx == plane.dz_dx && p.dz_dy == plane.dz_dy && p.z_anchor == plane.z_anchor;
    });
    const auto index = static_cast<std::uint32_t>(known - scene_.planes.begin());
    if (known == scene_.planes.end()) scene_.planes.push_back(plane);
    push({toGrid(corners[0]), toGrid(corners[1]), toGrid(corners[2])}, index);
}

void StiffSceneBuilder::push(std::array<glm::dvec2, 3> px, std::uint32_t plane) {
    const Owner owner = next_++;
    const int turn = orientation(px[0], px[1], px[2]);
    if (turn == 0) return;
    if (turn < 0) std::swap(px[1], px[2]);
    ScreenTriangle triangle{px, {}, owner, plane};
    for (std::size_t k = 0; k < 3; ++k) {
        // A vertex of its own each: planes decide at shared corners, not the file's topology.
        triangle.vertex[k] = static_cast<std::uint32_t>(vertices_.size());
        vertices_.push_back(px[k]);
    }
    scene_.triangles.push_back(triangle);
}

}  // namespace edgewise::judge
