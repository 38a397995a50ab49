#include "analytic/base_point.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "analytic/double_double.h"

namespace edgewise {
namespace {

/// Callers look up owners by coordinates in double, of up to 2^20 px: they cannot be wrong farther from a
/// segment than this.
constexpr double kLookupPx = 0x1p-31;

/// B and a vertex nearer than 2^-50 px are one point: their coordinates relative to the sample carry two
/// roundings. A segment no longer than that is a point too, and has no side.
constexpr double kOnePoint2 = 0x1p-100;

struct Ends {
    glm::dvec2 a, b;  // relative to the sample, as the edge terms see them
};

glm::dvec2 relative(const FinePoint& p, glm::dvec2 sample) {
    return (p.grid - sample) + p.rest;
}
double dot(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.x + a.y * b.y;
}

/// The sign of cross(a - sample, b - sample), from the line.
double sideOfSample(const CarrierLine& l, glm::dvec2 sample) {
    const glm::dvec2 d = sample - l.origin;
    const f64::dd x = f64::ddMulReal(f64::dd{l.nx_hi, l.nx_lo}, d.x),
                  y = f64::ddMulReal(f64::dd{l.ny_hi, l.ny_lo}, d.y);
    return f64::ddAdd(f64::ddAdd(x, y), f64::dd{l.c_hi, l.c_lo}).hi;
}

/// Both ends inside the support: true; both outside: false; one each: it crosses the border, and its crossing
/// tells.
std::optional<bool> bothInside(bool radial, double R, const Ends& e) {
    const auto inside = [=](glm::dvec2 p) { return radial ? dot(p, p) <= R * R : !(p.x > R); };
    if (inside(e.a) != inside(e.b)) return std::nullopt;
    return inside(e.a);
}

}  // namespace

void considerBase(BasePoint& base, bool radial, double R, glm::dvec2 sample, const VisibleSegment& segment,
                  const CarrierLine& line, Owner left, Owner right) {
    if (segment.length * segment.length <= kOnePoint2) return;
    const Ends ends{relative(segment.a, sample), relative(segment.b, sample)};
    const glm::dvec2 B{R, 0.0}, d = line.direction;
    const double near = std::min(kLookupPx, R * 0x1p-20);
    const double t = dot(B - ends.a, d), across = (B.x - ends.a.x) * d.y - (B.y - ends.a.y) * d.x;
    // A shared vertex at B is an end of each of its segments, and equally near, whatever t rounds to.
    const bool first = dot(B - ends.a, B - ends.a) < dot(B - ends.b, B - ends.b);
    const glm::dvec2 end = first ? ends.a : ends.b;
    const double end2 = dot(B - end, B - end);
    const bool at_end = t <= 0 || t >= segment.length || end2 <= kOnePoint2;
    const double nearest2 = at_end ? end2 : across * across;
    const double distance2 = nearest2 <= kOnePoint2 ? 0.0 : nearest2;
    if (!(distance2 <= near * near)) return;
    const std::optional<bool> inside = bothInside(radial, R, ends);
    if (!inside) return;
    // the border lies beyond the segment (+x) when it is inside, else on its near side
    const double way = *inside ? 1.0 : -1.0;
    const double cosine = at_end ? way * (first ? d.x : -d.x) : 0.0;
    const bool sample_is_left = radial ? sideOfSample(line, sample) > 0 : true;
    const Owner owner = sample_is_left != *inside ? left : right;
    const BasePoint fresh{distance2, cosine, owner};
    const auto key = [](const BasePoint& p) { return std::make_tuple(p.distance2, -p.cosine, p.owner); };
    if (key(fresh) < key(base)) base = fresh;
}

}  // namespace edgewise
