#include "tests/witness/local_scene.h"

#include <algorithm>
#include <cmath>

namespace edgewise::witness {
namespace {

using Point = std::array<Quad, 2>;

Affine normalised(Quad a, Quad b, Quad c) {
    const Real length = std::hypot(Real(a), Real(b));
    if (length == 0) return {0, 0, Real(c > 0 ? 1 : c < 0 ? -1 : 0)};
    return {Real(a / length), Real(b / length), Real(c / length)};
}

Side makeSide(const Point& p, const Point& q) {
    const Quad du = q[0] - p[0], dv = q[1] - p[1];
    Side side;
    side.line = normalised(-dv, du, dv * p[0] - du * p[1]);
    side.v_lo = Real(std::min(p[1], q[1]));
    side.v_hi = Real(std::max(p[1], q[1]));
    if (dv != 0) {
        side.slope = Real(du / dv);
        side.u_at_0 = Real(p[0] - du * p[1] / dv);
    }
    return side;
}

LocalTriangle makeLocal(const ScreenTriangle& triangle, glm::dvec2 sample_px) {
    std::array<Point, 3> p;
    LocalTriangle local;
    for (int k = 0; k < 3; ++k) {
        p[k] = {Quad(triangle.p_px[k].x) - sample_px.x, Quad(triangle.p_px[k].y) - sample_px.y};
        local.corner[k] = {Real(p[k][0]), Real(p[k][1])};
    }
    for (int k = 0; k < 3; ++k) local.side[k] = makeSide(p[k], p[(k + 1) % 3]);
    local.owner = triangle.owner;
    local.plane = triangle.plane;
    local.v_lo = std::min({local.corner[0][1], local.corner[1][1], local.corner[2][1]});
    local.v_hi = std::max({local.corner[0][1], local.corner[1][1], local.corner[2][1]});
    return local;
}

/// The largest value of an affine function on the square, and the smallest.
Real most(const Affine& f, Real radius) {
    return f.c + (std::fabs(f.a) + std::fabs(f.b)) * radius;
}
Real least(const Affine& f, Real radius) {
    return f.c - (std::fabs(f.a) + std::fabs(f.b)) * radius;
}

bool meets(const LocalTriangle& t, Real radius) {
    Real lo = t.corner[0][0], hi = lo;
    for (const auto& p : t.corner) lo = std::min(lo, p[0]), hi = std::max(hi, p[0]);
    if (lo > radius || hi < -radius || t.v_lo > radius || t.v_hi < -radius) return false;
    return std::all_of(t.side.begin(), t.side.end(),
                       [&](const Side& s) { return most(s.line, radius) >= 0; });
}

bool covers(const LocalTriangle& t, Real radius) {
    return std::all_of(t.side.begin(), t.side.end(),
                       [&](const Side& s) { return least(s.line, radius) > 0; });
}

}  // namespace

Real LocalTriangle::depthInside(Real u, Real v) const {
    return std::min({side[0].line.at(u, v), side[1].line.at(u, v), side[2].line.at(u, v)});
}

LocalScene::LocalScene(const ScreenScene& scene, glm::dvec2 sample_px, Real radius) : planes_(scene.planes) {
    anchor_ = {Quad(scene.anchor_px.x) - sample_px.x, Quad(scene.anchor_px.y) - sample_px.y};
    for (const ScreenTriangle& triangle : scene.triangles) {
        LocalTriangle local = makeLocal(triangle, sample_px);
        local.see_through = scene.seesThrough(triangle.owner);
        if (meets(local, radius)) triangles_.push_back(local);
    }
    dropHidden(radius);
    nearer_.resize(triangles_.size() * triangles_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i)
        for (std::size_t j = 0; j < triangles_.size(); ++j)
            nearer_[i * triangles_.size() + j] = difference(triangles_[i], triangles_[j]);
}

void LocalScene::dropHidden(Real radius) {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        if (triangles_[i].see_through || !covers(triangles_[i], radius)) continue;
        const LocalTriangle front = triangles_[i];
        std::erase_if(triangles_, [&](const LocalTriangle& t) {
            return t.plane != front.plane && least(difference(front, t), radius) > 0;
        });
    }
}

Affine LocalScene::difference(const LocalTriangle& i, const LocalTriangle& j) const {
    if (i.plane == j.plane) return {};
    const DepthPlane &p = planes_[i.plane], &q = planes_[j.plane];
    const Quad a = Quad(p.dz_dx) - q.dz_dx, b = Quad(p.dz_dy) - q.dz_dy;
    return normalised(a, b, Quad(p.z_anchor) - q.z_anchor - a * anchor_[0] - b * anchor_[1]);
}

bool LocalScene::wins(std::size_t i, std::size_t j, Real u, Real v) const {
    const Real difference_here = nearer(i, j).at(u, v);
    if (difference_here != 0) return difference_here > 0;
    return triangles_[i].owner < triangles_[j].owner;
}

Owner ownerAt(const ScreenScene& scene, glm::dvec2 point_px) {
    Owner best = kBackground;
    Quad best_z = 0;
    for (const ScreenTriangle& t : scene.triangles) {
        bool inside = true;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2 a = t.p_px[k], b = t.p_px[(k + 1) % 3];
            const Quad cross =
                (Quad(b.x) - a.x) * (Quad(point_px.y) - a.y) - (Quad(b.y) - a.y) * (Quad(point_px.x) - a.x);
            inside = inside && cross >= 0;
        }
        if (!inside) continue;
        const DepthPlane& plane = scene.planes[t.plane];
        const Quad z = plane.dz_dx * (Quad(point_px.x) - scene.anchor_px.x) +
                       plane.dz_dy * (Quad(point_px.y) - scene.anchor_px.y) + plane.z_anchor;
        if (best == kBackground || z > best_z || (z == best_z && t.owner < best)) {
            best = t.owner;
            best_z = z;
        }
    }
    return best;
}

}  // namespace edgewise::witness
