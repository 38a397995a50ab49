#include "sdf/closest_approach.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/evaluate.h"

namespace edgewise::sdf {

std::optional<ClosestApproach> closestApproach(const CellTapes& cells, const FieldRay& ray, double t_start) {
    constexpr int kMostSteps = 12;
    // Of a pixel's radius: beside it the error of the distance is its square.
    constexpr double kSettled = 1.0 / 64.0;
    double t = t_start;
    for (int step = 0; step < kMostSteps; ++step) {
        const glm::dvec3 p = ray.origin_world + ray.direction_world * t;
        const ValueAndGradient at = gradientAt(cells.at(p).tape, p);
        const double slope = glm::length(at.gradient);
        if (!(at.value > 0.0) || !(slope > 0.0)) return std::nullopt;
        const glm::dvec3 surface = p - at.gradient * (at.value / (slope * slope));
        const double next = glm::dot(surface - ray.origin_world, ray.direction_world);
        if (!std::isfinite(next)) return std::nullopt;
        const double radius = ray.pixel_radius + ray.pixel_slope * t;
        if (std::abs(next - t) <= kSettled * radius)
            return ClosestApproach{t, surface, at.gradient / slope, at.value / slope};
        t = next;
    }
    return std::nullopt;
}

}  // namespace edgewise::sdf
