// Depth planes about a cell's corner, compared with a floating-point filter and an exact fallback.
#pragma once

#include <cmath>

#include "analytic/exact_depth.h"
#include "analytic/screen_triangle.h"

namespace edgewise {

/// z(x, y) = a x + b y + c at (x, y) px from the cell's origin. `error` bounds, for |x|, |y| <= reach, the rounding of
/// evaluating it and of moving the point to the anchor's frame.
struct LocalPlane {
    double a, b, c, error;
    std::uint32_t plane;
    Owner owner;
};

inline LocalPlane localPlane(const ScreenScene& scene, const ScreenTriangle& t, glm::dvec2 origin, double reach_px) {
    const DepthPlane& p = scene.planes[t.plane];
    const glm::dvec2 d = origin - scene.anchor_px;
    const double x = p.dz_dx * d.x, y = p.dz_dy * d.y;
    // Roundings: two products, two sums for c; two products, two sums at the point; one in each moved coordinate.
    const double size = std::abs(p.z_anchor) + std::abs(p.dz_dx) * (std::abs(d.x) + reach_px) +
                        std::abs(p.dz_dy) * (std::abs(d.y) + reach_px);
    return {p.dz_dx, p.dz_dy, p.z_anchor + (x + y), 8.0 * 0x1p-53 * size, t.plane, t.owner};
}

inline double depthAt(const LocalPlane& p, double x, double y) { return p.c + (p.a * x + p.b * y); }

/// Whether p is seen in front of q at (x, y) from the origin; counts the exact evaluations.
inline bool inFront(const ScreenScene& scene, glm::dvec2 origin, const LocalPlane& p, const LocalPlane& q, double x,
                    double y, std::uint64_t& exact_count) {
    if (p.plane == q.plane) return p.owner < q.owner;
    const double d = depthAt(p, x, y) - depthAt(q, x, y);
    const double error = p.error + q.error;
    if (d > error) return true;
    if (d < -error) return false;
    ++exact_count;
    const glm::dvec2 offset = origin - scene.anchor_px;
    const int sign =
        depthDifferenceSign(scene.planes[p.plane], scene.planes[q.plane], offset.x + x, offset.y + y);
    return sign != 0 ? sign > 0 : p.owner < q.owner;
}

}  // namespace edgewise
