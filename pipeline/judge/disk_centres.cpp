#include "pipeline/judge/disk_centres.h"

#include <algorithm>
#include <cmath>

namespace edgewise::judge {
namespace {

using exact::Point;
using exact::Rational;

/// The points p with cross(along, p - start) >= least: a face is on this hand of its directed sides.
struct HalfPlane {
    Point start, along;
    Rational least = 0;

    Rational excess(const Point& p) const {
        return along.x * (p.y - start.y) - along.y * (p.x - start.x) - least;
    }
};

HalfPlane handOf(const Point& a, const Point& b) {
    return {a, {b.x - a.x, b.y - a.y}};
}

bool holds(const HalfPlane& half, const exact::Face& face) {
    return std::ranges::all_of(face.cycles, [&](const auto& cycle) {
        return std::ranges::all_of(cycle, [&](const Point& p) { return half.excess(p) >= 0; });
    });
}

/// A double no longer than the vector.
double lengthBelow(const Point& v) {
    const Rational squared = v.x * v.x + v.y * v.y;
    double length = std::sqrt(static_cast<double>(squared));
    while (Rational(length) * length > squared) length = std::nextafter(length, 0.0);
    return length;
}

std::vector<Point> cut(const std::vector<Point>& polygon, const HalfPlane& half) {
    std::vector<Point> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const Rational at_p = half.excess(p), at_q = half.excess(q);
        if (at_p >= 0) kept.push_back(p);
        if (!(at_p < 0 && at_q > 0) && !(at_p > 0 && at_q < 0)) continue;
        const Rational share = at_p / (at_p - at_q);
        kept.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
    }
    return kept;
}

std::vector<Point> cornersOf(const exact::Region& box) {
    return {{box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}};
}

}  // namespace

DiskCentres diskCentres(const exact::Face& face, const exact::Region& box, double radius_px) {
    DiskCentres centres{cornersOf(box), true};
    for (const auto& cycle : face.cycles)
        for (std::size_t i = 0; i < cycle.size(); ++i) {
            HalfPlane half = handOf(cycle[i], cycle[(i + 1) % cycle.size()]);
            if (!holds(half, face)) {
                centres.convex_face = false;
                continue;
            }
            half.least = Rational(radius_px) * lengthBelow(half.along);
            centres.corners = cut(centres.corners, half);
        }
    return centres;
}

Point meanOf(const std::vector<Point>& corners) {
    Point sum{0, 0};
    for (const Point& p : corners) sum.x += p.x, sum.y += p.y;
    return {sum.x / corners.size(), sum.y / corners.size()};
}

}  // namespace edgewise::judge
