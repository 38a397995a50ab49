#include "analytic/exact/owner_at.h"

#include <algorithm>
#include <cmath>

namespace edgewise::exact {
namespace {

/// A point in doubles, |double - exact| <= the rounding of one conversion.
struct Nearby {
    double x, y;
};

bool farFrom(const ScreenTriangle& t, const Nearby& p) {
    const auto [x0, x1] = std::minmax({t.p_px[0].x, t.p_px[1].x, t.p_px[2].x});
    const auto [y0, y1] = std::minmax({t.p_px[0].y, t.p_px[1].y, t.p_px[2].y});
    // A double near a grid point is off by less than the grid's step.
    return p.x < x0 - kGridPx || p.x > x1 + kGridPx || p.y < y0 - kGridPx || p.y > y1 + kGridPx;
}

/// cross(b - a, p - a), of the sign that the exact one has; doubles decide where they surely can: p and each
/// difference are off by at most 2^-32 px, and products by some roundings more.
int side(glm::dvec2 a, glm::dvec2 b, const Point& p, const Nearby& near) {
    const glm::dvec2 e = b - a;
    const double px = e.x * (near.y - a.y), py = e.y * (near.x - a.x);
    const double doubt = (std::abs(e.x) + std::abs(e.y)) * 0x1p-31 + (std::abs(px) + std::abs(py)) * 0x1p-50;
    if (std::abs(px - py) > doubt) return px > py ? 1 : -1;
    return Rational(Rational(e.x) * (p.y - Rational(a.y)) - Rational(e.y) * (p.x - Rational(a.x))).sign();
}

bool holds(const ScreenTriangle& t, const Point& p, const Nearby& near) {
    if (farFrom(t, near)) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (side(t.p_px[k], t.p_px[(k + 1) % 3], p, near) < 0) return false;
    return true;
}

Rational depthAt(const ScreenScene& scene, const DepthPlane& z, const Point& p) {
    return Rational(z.dz_dx) * (p.x - Rational(scene.anchor_px.x)) +
           Rational(z.dz_dy) * (p.y - Rational(scene.anchor_px.y)) + Rational(z.z_anchor);
}

/// A depth in doubles and what it may be off by: the point as above, and some roundings.
struct NearbyDepth {
    double value, doubt;
};

NearbyDepth nearbyDepth(const ScreenScene& scene, const DepthPlane& z, const Nearby& near) {
    const double x = z.dz_dx * (near.x - scene.anchor_px.x), y = z.dz_dy * (near.y - scene.anchor_px.y);
    return {x + y + z.z_anchor, (std::abs(x) + std::abs(y) + std::abs(z.z_anchor)) * 0x1p-49 +
                                    (std::abs(z.dz_dx) + std::abs(z.dz_dy)) * 0x1p-31};
}

}  // namespace

Owner ownerAt(const ScreenScene& scene, const Point& p) {
    const Nearby near{static_cast<double>(p.x), static_cast<double>(p.y)};
    const ScreenTriangle* best = nullptr;
    NearbyDepth nearest{0, 0};
    for (const ScreenTriangle& t : scene.triangles) {
        if (!holds(t, p, near)) continue;
        const DepthPlane& plane = scene.planes[t.plane];
        const NearbyDepth depth = nearbyDepth(scene, plane, near);
        const double ahead = depth.value - nearest.value, doubt = depth.doubt + nearest.doubt;
        if (best && ahead < -doubt) continue;
        if (best && !(ahead > doubt)) {
            const Rational exact = depthAt(scene, plane, p) - depthAt(scene, scene.planes[best->plane], p);
            if (exact < 0 || (exact == 0 && best->owner < t.owner)) continue;
        }
        best = &t, nearest = depth;
    }
    return best ? best->owner : kBackground;
}

}  // namespace edgewise::exact
