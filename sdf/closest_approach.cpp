#include "sdf/closest_approach.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/evaluate.h"

namespace edgewise::sdf {
namespace {

constexpr int kMostSteps = 20;
/// Growth is the sine of how far the nearest point lies off the plane across the ray.
constexpr double kAcross = 1.0 / 32.0;
/// A gradient takes as long as about so many values.
constexpr std::uint32_t kPassesOfGradient = 3;
/// Of a pixel's radius: how much nearer the ray may come elsewhere.
constexpr double kSettled = 1.0 / 64.0;
/// Of a pixel's radius: the growth leaps where it changes sign within that without coming near zero.
constexpr double kTipWidth = 0.25;
/// Of a pixel's radius: shorter steps tell little of how the growth changes.
constexpr double kShortestStep = 0.25;

/// The field at a point of the ray.
struct Asked {
    double t = NAN;
    double value = 0.0, slope = 1.0;  ///< > 0
    double growth = 0.0;              ///< the value's along the ray, over the slope: in [-1, 1]
    glm::dvec3 outwards_world{0.0};   ///< unit
    double distance() const { return value / slope; }
    double rate() const { return growth * slope; }
};

/// The root of the growth, from below zero to above: secants while they stay between what is known, halves
/// else.
class GrowthRoot {
  public:
    explicit GrowthRoot(double radius) : radius_(radius) {}

    /// Whether no place of the ray is much nearer to the solid, if the distance is convex along it.
    bool take(const Asked& asked) {
        const Asked last = last_;
        last_ = asked;
        (asked.growth < 0.0 ? before_ : after_) = asked;
        if (asked.growth == 0.0 || (between() && settled(asked))) return true;
        next_ = asked.t + (asked.growth < 0.0 ? step(asked, last) : -step(asked, last));
        if (!between()) return false;
        if (leaps() && std::isnan(met_))
            next_ = met_ = tangentsMeet();
        else if (leaps() && asked.t == met_)
            next_ = asked.t + std::copysign(kTipWidth * radius_, -asked.growth);
        else
            met_ = NAN;
        if (!(next_ > before_.t && next_ < after_.t)) next_ = 0.5 * (before_.t + after_.t);
        return false;
    }
    double next() const { return next_; }
    /// Whether the growth leaps: of two faces, one is nearest before the root and the other after it.
    bool leaps() const { return between() && std::min(-before_.growth, after_.growth) > kAcross; }
    const Asked& before() const { return before_; }
    const Asked& after() const { return after_; }
    /// The next one is within the solid: nearer to where the ray is outside.
    bool shorten() {
        if (std::isnan(last_.t)) return false;
        next_ = 0.5 * (next_ + last_.t);
        return true;
    }

  private:
    /// Past the root that a secant says, so that it lies between two.
    static constexpr double kOvershoot = 1.0 + 1.0 / 16.0;

    bool between() const { return before_.t < after_.t; }
    /// Near enough, and seen across the ray: what is nearest beside a face before its edge faces elsewhere
    /// than the edge. At a tip of the distance the growth leaps from one side to the other.
    bool settled(const Asked& asked) const {
        const double width = (after_.t - before_.t) / radius_;
        return asked.value - least() <= kSettled * radius_ * asked.slope &&
               (std::abs(asked.growth) <= kAcross || width <= (leaps() ? kTipWidth : kSettled));
    }
    /// Where the tangents on the two sides meet.
    double tangentsMeet() const {
        const double rise = after_.rate();
        return before_.t +
               (before_.value - after_.value + rise * (after_.t - before_.t)) / (rise - before_.rate());
    }
    double least() const { return before_.value + before_.rate() * (tangentsMeet() - before_.t); }
    /// At first to where the ray passes the point that is nearest now: all the way for straight edges and
    /// corners. Then to the secant's root, but not beyond where the tangent says that the surface is.
    double step(const Asked& asked, const Asked& last) const {
        const double steep = std::abs(asked.growth);
        if (std::isnan(last.t))
            return kOvershoot * std::max(asked.distance() * steep, kShortestStep * radius_);
        const double bend = (asked.growth - last.growth) / (asked.t - last.t);
        const double surface = asked.distance() / steep;
        return bend > 0.0 ? std::min(kOvershoot * steep / bend, surface) : surface;
    }

    const double radius_;
    Asked last_, before_, after_;
    double next_ = 0.0;
    double met_ = NAN;  ///< where tangents met, if the last step went there
};

/// Where a ray passes the edge in which two faces meet, each the plane that lies its distance inwards of a
/// point of the ray. A field that is the greater one of two has no gradient across the ray there: where it is
/// least, neither face is what the ray passes. None where the ray runs along the edge.
std::optional<ClosestApproach> passedEdge(const FieldRay& ray, const Asked& a, const Asked& b) {
    const glm::dvec3 d = ray.direction_world, edge = glm::cross(a.outwards_world, b.outwards_world);
    const glm::dvec3 across = glm::cross(d, edge);
    const double size = glm::dot(edge, edge), turned = glm::dot(across, across);
    if (!(turned > size * (kAcross * kAcross))) return std::nullopt;
    // From the ray's point at a.t: the planes' heights, then a point of their edge.
    const double to_a = -a.distance(), to_b = glm::dot(b.outwards_world, d) * (b.t - a.t) - b.distance();
    const glm::dvec3 on_edge =
        (to_a * glm::cross(b.outwards_world, edge) + to_b * glm::cross(edge, a.outwards_world)) / size;
    const double along = glm::dot(glm::cross(on_edge, edge), across) / turned;
    const double aside = -glm::dot(on_edge, across) / std::sqrt(turned);
    const glm::dvec3 outwards = across * (std::copysign(1.0, aside) / std::sqrt(turned));
    const double distance = std::abs(aside);
    if (!(distance > 0.0) || !std::isfinite(along)) return std::nullopt;
    const double t = a.t + along;
    return ClosestApproach{t, ray.origin_world + d * t - outwards * distance, outwards, distance};
}

}  // namespace

std::optional<ClosestApproach> closestApproach(const CellTapes& cells, const FieldRay& ray, double t_start) {
    const double radius = ray.pixel_radius + ray.pixel_slope * t_start;
    GrowthRoot root(radius);
    PruneCounts counts;
    const TapeCell* cell = nullptr;
    double t = t_start;
    for (int step = 0; step < kMostSteps; ++step) {
        const glm::dvec3 p = ray.origin_world + ray.direction_world * t;
        cell = &cells.at(p, cell, radius, counts);
        cells.ran(*cell, kPassesOfGradient);
        const ValueAndGradient at = gradientAt(cell->tape, p);
        const double slope = glm::length(at.gradient);
        if (!(at.value > 0.0)) {
            if (!root.shorten()) return std::nullopt;
        } else {
            if (!(slope > 0.0)) return std::nullopt;
            const glm::dvec3 outwards = at.gradient / slope;
            const Asked asked{t, at.value, slope, glm::dot(outwards, ray.direction_world), outwards};
            if (root.take(asked)) {
                if (root.leaps())
                    if (const auto edge = passedEdge(ray, root.before(), root.after())) return edge;
                return ClosestApproach{t, p - outwards * asked.distance(), outwards, asked.distance()};
            }
        }
        t = root.next();
        if (!std::isfinite(t)) return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace edgewise::sdf
