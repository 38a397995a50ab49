#include "tests/witness/events.h"

#include <algorithm>
#include <cmath>

namespace edgewise::witness {
namespace {

/// Distance in px below which an event counts as inside, or as not yet hidden: too large only costs time.
constexpr Real kKeepMargin = 1e-9L;

/// A straight boundary: a side of triangle i, or the line where i and j are equally deep.
struct Boundary {
    Affine line;
    std::size_t i = 0, j = 0;
    bool is_depth = false;
    Real v_lo = 0, v_hi = 0;
};

class EventFinder {
  public:
    EventFinder(const LocalScene& scene, const Kernel& kernel) : scene_(scene), kernel_(kernel) {}

    std::vector<Real> find() {
        found_ = {-kernel_.radius, kernel_.radius};
        if (kernel_.apex) found_.push_back(0);
        found_.insert(found_.end(), kernel_.knots.begin(), kernel_.knots.end());
        collectBoundaries();
        addCorners();
        for (const Boundary& boundary : boundaries_) addSupportCrossings(boundary);
        for (std::size_t k = 0; k < boundaries_.size(); ++k)
            for (std::size_t l = k + 1; l < boundaries_.size(); ++l)
                addCrossing(boundaries_[k], boundaries_[l]);
        std::sort(found_.begin(), found_.end());
        found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
        return found_;
    }

  private:
    const LocalScene& scene_;
    const Kernel& kernel_;
    std::vector<Boundary> boundaries_;
    std::vector<Real> found_;

    bool lineMeetsSupport(const Affine& line) const {
        return (line.a != 0 || line.b != 0) &&
               std::fabs(line.c) <= (std::fabs(line.a) + std::fabs(line.b)) * kernel_.radius;
    }

    void collectBoundaries() {
        const auto& triangles = scene_.triangles();
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            for (const Side& side : triangles[i].side)
                if (lineMeetsSupport(side.line))
                    boundaries_.push_back({side.line, i, i, false, side.v_lo, side.v_hi});
            for (std::size_t j = i + 1; j < triangles.size(); ++j) {
                const Affine& line = scene_.nearer(i, j);
                const Real lo = std::max(triangles[i].v_lo, triangles[j].v_lo);
                const Real hi = std::min(triangles[i].v_hi, triangles[j].v_hi);
                if (lo < hi && lineMeetsSupport(line)) boundaries_.push_back({line, i, j, true, lo, hi});
            }
        }
    }

    void addCorners() {
        for (std::size_t i = 0; i < scene_.triangles().size(); ++i)
            for (const auto& p : scene_.triangles()[i].corner) addPoint(p[0], p[1], i, i);
    }

    void addSupportCrossings(const Boundary& b) {
        if (kernel_.disk) {
            const Real squared = kernel_.radius * kernel_.radius - b.line.c * b.line.c;
            if (squared < 0) return;
            for (Real along : {-std::sqrt(squared), std::sqrt(squared)})
                addOn(b, -b.line.c * b.line.a - along * b.line.b, -b.line.c * b.line.b + along * b.line.a);
            return;
        }
        addAbscissa(b, -kernel_.radius);
        addAbscissa(b, kernel_.radius);
        for (Real knot : kernel_.knots) addAbscissa(b, knot);
    }

    void addAbscissa(const Boundary& b, Real u) {
        if (b.line.b != 0) addOn(b, u, -(b.line.a * u + b.line.c) / b.line.b);
    }

    void addOn(const Boundary& b, Real u, Real v) {
        if (onBoundary(b, u, v)) addPoint(u, v, b.i, b.j);
    }

    /// Two depth lines of opaque triangles meet visibly only where three are equally deep, so they share one.
    void addCrossing(const Boundary& b, const Boundary& d) {
        if (b.v_hi < d.v_lo - kKeepMargin || d.v_hi < b.v_lo - kKeepMargin) return;
        const bool shares = b.i == d.i || b.i == d.j || b.j == d.i || b.j == d.j;
        const bool opaque = ends(b.i) && ends(b.j) && ends(d.i) && ends(d.j);
        if (b.is_depth && d.is_depth && !shares && opaque) return;
        const Real determinant = b.line.a * d.line.b - b.line.b * d.line.a;
        if (determinant == 0) return;
        const Real u = (b.line.b * d.line.c - b.line.c * d.line.b) / determinant;
        const Real v = (b.line.c * d.line.a - b.line.a * d.line.c) / determinant;
        if (!insideSupport(u, v) || !onBoundary(b, u, v) || !onBoundary(d, u, v)) return;
        if (!hidden(b.i, u, v) && !hidden(b.j, u, v)) addPoint(u, v, d.i, d.j);
    }

    bool insideSupport(Real u, Real v) const {
        return std::max(std::fabs(u), std::fabs(v)) <= kernel_.radius + kKeepMargin;
    }

    bool onBoundary(const Boundary& b, Real u, Real v) const {
        if (v < b.v_lo - kKeepMargin || v > b.v_hi + kKeepMargin) return false;
        return !b.is_depth || (scene_.triangles()[b.i].depthInside(u, v) >= -kKeepMargin &&
                               scene_.triangles()[b.j].depthInside(u, v) >= -kKeepMargin);
    }

    /// Whether the view ends at a triangle.
    bool ends(std::size_t i) const { return !scene_.triangles()[i].see_through; }

    /// Some other opaque triangle covers the neighbourhood of (u, v) and is nearer there than triangle i.
    bool hidden(std::size_t i, Real u, Real v) const {
        for (std::size_t t = 0; t < scene_.triangles().size(); ++t)
            if (t != i && ends(t) && scene_.nearer(t, i).at(u, v) > kKeepMargin &&
                scene_.triangles()[t].depthInside(u, v) > kKeepMargin)
                return true;
        return false;
    }

    void addPoint(Real u, Real v, std::size_t i, std::size_t j) {
        if (std::fabs(v) < kernel_.radius && insideSupport(u, v) && !hidden(i, u, v) &&
            (i == j || !hidden(j, u, v)))
            found_.push_back(v);
    }
};

}  // namespace

std::vector<Real> eventOrdinates(const LocalScene& scene, const Kernel& kernel) {
    return EventFinder(scene, kernel).find();
}

}  // namespace edgewise::witness
