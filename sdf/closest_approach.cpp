#include "sdf/closest_approach.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/evaluate.h"

namespace edgewise::sdf {
namespace {

constexpr int kMostSteps = 16;
/// A gradient takes as long as about so many values.
constexpr std::uint32_t kPassesOfGradient = 3;
/// Of a pixel's radius: how much nearer the ray may come elsewhere.
constexpr double kSettled = 1.0 / 64.0;
/// Of a pixel's radius: shorter steps tell little of how the growth changes.
constexpr double kShortestStep = 0.25;

/// The field at a point of the ray.
struct Asked {
    double t = NAN;
    double distance = 0.0;  ///< value over slope
    double growth = 0.0;    ///< of the distance along the ray: in [-1, 1]
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
        if (asked.growth == 0.0 || (between() && asked.distance - least() <= kSettled * radius_)) return true;
        next_ = asked.t + (asked.growth < 0.0 ? step(asked, last) : -step(asked, last));
        if (between() && !(next_ > before_.t && next_ < after_.t)) next_ = 0.5 * (before_.t + after_.t);
        return false;
    }
    double next() const { return next_; }
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
    /// Where the tangents on the two sides meet.
    double least() const {
        const double fall = -before_.growth, rise = after_.growth;
        const double along =
            (before_.distance - after_.distance + rise * (after_.t - before_.t)) / (fall + rise);
        return before_.distance - fall * along;
    }
    /// At first to where the ray passes the point that is nearest now: all the way for straight edges and
    /// corners. Then to the secant's root, but not beyond where the tangent says that the surface is.
    double step(const Asked& asked, const Asked& last) const {
        const double steep = std::abs(asked.growth);
        if (std::isnan(last.t)) return kOvershoot * std::max(asked.distance * steep, kShortestStep * radius_);
        const double bend = (asked.growth - last.growth) / (asked.t - last.t);
        const double surface = asked.distance / steep;
        return bend > 0.0 ? std::min(kOvershoot * steep / bend, surface) : surface;
    }

    const double radius_;
    Asked last_, before_, after_;
    double next_ = 0.0;
};

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
            const double distance = at.value / slope;
            if (root.take({t, distance, glm::dot(outwards, ray.direction_world)}))
                return ClosestApproach{t, p - outwards * distance, outwards, distance};
        }
        t = root.next();
        if (!std::isfinite(t)) return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace edgewise::sdf
