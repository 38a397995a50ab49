// Depth planes about a cell's corner, compared with a floating-point filter.
#pragma once

#include <cmath>

#include "analytic/screen_triangle.h"

namespace edgewise {

/// z(x, y) = a x + b y + c at (x, y) px from the cell's origin. `error` bounds, for |x|, |y| <= reach, the
/// rounding of evaluating it and of moving the point to the anchor's frame.
struct LocalPlane {
    double a, b, c, error;
    std::uint32_t plane;
    Owner owner;
};

inline LocalPlane localPlane(const ScreenScene& scene, const ScreenTriangle& t, glm::dvec2 origin,
                             double reach_px) {
    const DepthPlane& p = scene.planes[t.plane];
    const glm::dvec2 d = origin - scene.anchor_px;
    const double x = p.dz_dx * d.x, y = p.dz_dy * d.y;
    // Roundings: two products, two sums for c; two products, two sums at the point; one in each moved
    // coordinate.
    const double size = std::abs(p.z_anchor) + std::abs(p.dz_dx) * (std::abs(d.x) + reach_px) +
                        std::abs(p.dz_dy) * (std::abs(d.y) + reach_px);
    return {p.dz_dx, p.dz_dy, p.z_anchor + (x + y), 8.0 * 0x1p-53 * size, t.plane, t.owner};
}

inline double depthAt(const LocalPlane& p, double x, double y) {
    return p.c + (p.a * x + p.b * y);
}

/// Compares p and q at (x, y) from the origin: 1 where p is surely in front, -1 where q is, 0 where rounding
/// leaves it open. Triangles of one plane, and pieces of one owner, are decided by index.
inline int filteredOrder(const LocalPlane& p, const LocalPlane& q, double x, double y) {
    if (p.plane == q.plane) return p.owner < q.owner ? 1 : -1;
    const double d = depthAt(p, x, y) - depthAt(q, x, y);
    const double error = p.error + q.error;
    return d > error ? 1 : d < -error ? -1 : 0;
}

}  // namespace edgewise
