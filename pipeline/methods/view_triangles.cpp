#include "pipeline/methods/view_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace edgewise {
namespace {

constexpr std::uint32_t kUnplaced = 0xffffffffu;

struct Box {
    glm::dvec2 low, high;
    bool holds(glm::dvec2 p) const { return p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y; }
    bool holds(const ScreenTriangle& t) const {
        return std::ranges::all_of(t.p_px, [&](glm::dvec2 p) { return holds(p); });
    }
    bool misses(const ScreenTriangle& t) const {
        const glm::dvec2 a = glm::min(glm::min(t.p_px[0], t.p_px[1]), t.p_px[2]);
        const glm::dvec2 b = glm::max(glm::max(t.p_px[0], t.p_px[1]), t.p_px[2]);
        return b.x < low.x || b.y < low.y || a.x > high.x || a.y > high.y;
    }
};

using Polygon = std::vector<glm::dvec2>;

/// Sutherland and Hodgman: what lies on the side of an axis' bound.
Polygon cut(const Polygon& in, int axis, double bound, double sign) {
    Polygon out;
    for (std::size_t i = 0; i < in.size(); ++i) {
        const glm::dvec2 a = in[i], b = in[(i + 1) % in.size()];
        const double da = sign * (a[axis] - bound), db = sign * (b[axis] - bound);
        if (da >= 0.0) out.push_back(a);
        if ((da >= 0.0) == (db >= 0.0)) continue;
        // From the outer end, so that the neighbour across the edge gets the same point.
        glm::dvec2 p = da < db ? a + (b - a) * (da / (da - db)) : b + (a - b) * (db / (db - da));
        p[axis] = bound;
        out.push_back(p);
    }
    return out;
}

Polygon cut(const ScreenTriangle& t, const Box& box) {
    Polygon polygon(t.p_px.begin(), t.p_px.end());
    for (int axis = 0; axis < 2; ++axis) {
        polygon = cut(polygon, axis, box.low[axis], 1.0);
        polygon = cut(polygon, axis, box.high[axis], -1.0);
    }
    return polygon;
}

class Builder {
  public:
    Builder(const ScreenScene& screen, const RayView& view, const Box& keep)
        : screen_(screen), view_(view), keep_(keep) {
        std::uint32_t ids = 0;
        for (const ScreenTriangle& t : screen.triangles)
            for (const std::uint32_t id : t.vertex) ids = std::max(ids, id + 1);
        placed_.assign(ids, kUnplaced);
    }

    void add(std::uint32_t i) {
        const ScreenTriangle& t = screen_.triangles[i];
        if (keep_.holds(t)) return addFan(i, {shared(t, 0), shared(t, 1), shared(t, 2)});
        std::vector<std::uint32_t> corners;
        for (const glm::dvec2 p : cut(t, keep_)) corners.push_back(place(t, p));
        addFan(i, corners);
    }

    ViewTriangles take() { return std::move(out_); }

  private:
    std::uint32_t shared(const ScreenTriangle& t, int corner) {
        std::uint32_t& index = placed_[t.vertex[corner]];
        if (index == kUnplaced) index = place(t, t.p_px[corner]);
        return index;
    }

    std::uint32_t place(const ScreenTriangle& t, glm::dvec2 p) {
        out_.vertices.emplace_back(view_.point(p, depthAt(screen_, t, p)));
        return static_cast<std::uint32_t>(out_.vertices.size() - 1);
    }

    void addFan(std::uint32_t i, const std::vector<std::uint32_t>& corners) {
        for (std::size_t k = 2; k < corners.size(); ++k) {
            out_.corners.emplace_back(corners[0], corners[k - 1], corners[k]);
            out_.triangle.push_back(i);
        }
    }

    const ScreenScene& screen_;
    const RayView& view_;
    const Box& keep_;
    std::vector<std::uint32_t> placed_;  ///< by vertex id
    ViewTriangles out_;
};

/// The power of 2 that brings a size to (1/2, 1].
double toUnit(double size) {
    return size > 0.0 ? std::exp2(-std::ceil(std::log2(size))) : 1.0;
}

RayView viewOf(const ScreenScene& screen, const Film& film, bool perspective, const Box& seen) {
    RayView view;
    view.perspective = perspective;
    view.centre_px = 0.5 * glm::dvec2(film.width, film.height);
    view.per_px = toUnit(0.5 * std::max(film.width, film.height));
    double nearest = -HUGE_VAL, farthest = HUGE_VAL;
    const auto take = [&](const ScreenTriangle& t, const auto& corners) {
        for (const glm::dvec2 p : corners) {
            const double depth = depthAt(screen, t, p);
            nearest = std::max(nearest, depth), farthest = std::min(farthest, depth);
        }
    };
    for (const ScreenTriangle& t : screen.triangles) {
        if (seen.holds(t))
            take(t, t.p_px);
        else if (!seen.misses(t))
            take(t, cut(t, seen));
    }
    if (!(nearest > -HUGE_VAL)) return view;
    view.front = nearest;
    view.depth_scale = perspective ? 1.0 / toUnit(nearest) : toUnit(nearest - farthest);
    return view;
}

}  // namespace

glm::dvec3 RayView::point(glm::dvec2 p_px, double depth) const {
    const glm::dvec2 at = direction(p_px);
    // Rounding may take a depth at the horizon to 0 or below: 2^40 times the nearest distance is far enough.
    if (perspective) {
        const double w = std::min(depth_scale / std::max(depth, depth_scale * 0x1p-40), 0x1p40);
        return {at * w, w};
    }
    return {at, 1.0 + (front - depth) * depth_scale};
}

double depthAt(const ScreenScene& screen, const ScreenTriangle& triangle, glm::dvec2 p_px) {
    const DepthPlane& plane = screen.planes[triangle.plane];
    const glm::dvec2 from_anchor = p_px - screen.anchor_px;
    return plane.dz_dx * from_anchor.x + (plane.dz_dy * from_anchor.y + plane.z_anchor);
}

ViewScene viewTriangles(const ScreenScene& screen, const Film& film, bool perspective, int margin_px) {
    const glm::dvec2 size(film.width, film.height), margin(margin_px + 1.0);
    const Box seen{-margin, size + margin}, keep{-margin - size, size + margin + size};
    ViewScene out{viewOf(screen, film, perspective, seen), {}, {}};
    Builder opaque(screen, out.view, keep), see_through(screen, out.view, keep);
    for (std::uint32_t i = 0; i < screen.triangles.size(); ++i) {
        if (seen.misses(screen.triangles[i])) continue;
        (screen.seesThrough(screen.triangles[i].owner) ? see_through : opaque).add(i);
    }
    out.opaque = opaque.take();
    out.see_through = see_through.take();
    return out;
}

}  // namespace edgewise
