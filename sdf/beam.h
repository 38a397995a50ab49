// Rays through a square of pixels, and what one value of the field says of all of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace edgewise::sdf {

struct Ball {
    glm::dvec3 centre_world;
    double radius;
};

/// Perspective: from one point, within an angle of the axis. Orthographic: parallel, within `half_width` of
/// it.
struct Beam {
    glm::dvec3 origin_world{0.0}, axis_world{0.0};
    double cosine = 1.0, sine = 0.0;  ///< of the angle, less than a right one
    double half_width = 0.0;

    glm::dvec3 at(double t) const { return origin_world + axis_world * t; }

    /// Around all points of the rays between a and b, a little larger for rounding. Perspective: with m =
    /// (a + b) / (2 cosine) along the axis, the rim's points at a and b are both sqrt(m^2 - a b) away.
    Ball around(double a, double b) const {
        const double rounding = 1e-9 * (std::abs(b) + half_width + glm::length(origin_world));
        if (sine == 0.0) {
            const double half = 0.5 * (b - a);
            return {at(a + half), std::sqrt(half * half + half_width * half_width) + rounding};
        }
        const double m = 0.5 * (a + b) / cosine;
        return {at(m), std::sqrt(std::max(m * m - a * b, 0.0)) + rounding};
    }

    /// How far from t, up and down, a ball of that radius about at(t) holds all rays; negative where it does
    /// not hold them at t. Perspective: s on a ray at the rim is within it where s^2 - 2 s t cosine + t^2 <=
    /// radius^2.
    double freeAround(double t, double radius) const {
        const double width = sine * t + half_width;
        const double rest = radius * radius - width * width;
        if (!(radius > 0.0) || !(rest > 0.0)) return -1.0;
        return std::sqrt(rest) - (1.0 - cosine) * t;
    }
};

}  // namespace edgewise::sdf
