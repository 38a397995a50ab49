#include "sdf/point_slopes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/unit_or.h"

namespace edgewise::sdf {
namespace {

constexpr std::size_t kEnds = 6;

/// The move of one Newton step; 0 where there is no slope.
glm::dvec3 stepOf(double value, const glm::dvec3& slope) {
    const double square = glm::dot(slope, slope);
    return square > 0.0 && std::isfinite(square) ? slope * (value / square) : glm::dvec3(0.0);
}

}  // namespace

double slopeReach(const PointField& field, const Lattice& lattice) {
    const glm::dvec3 low = lattice.corner({0, 0, 0}), high = lattice.corner(lattice.units());
    const glm::dvec3 far = glm::max(glm::abs(low), glm::abs(high));
    return 4.0 * std::sqrt(field.rounding()) * std::max({far.x, far.y, far.z});
}

std::vector<glm::dvec3> slopesAt(const PointField& field, std::span<const glm::dvec3> points, double reach) {
    std::vector<glm::dvec3> ends;
    ends.reserve(kEnds * points.size());
    for (const glm::dvec3& p : points)
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-reach, reach}) {
                glm::dvec3 end = p;
                end[axis] += side;
                ends.push_back(end);
            }
    const std::vector<double> values = field.values(ends);
    std::vector<glm::dvec3> slopes(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t at = kEnds * i + 2 * static_cast<std::size_t>(axis);
            slopes[i][axis] = (values[at + 1] - values[at]) / (2.0 * reach);
        }
    return slopes;
}

void moveOnSurface(const PointField& field, double reach, int steps, std::span<glm::dvec3> points) {
    for (int step = 0; step < steps; ++step) {
        const std::vector<double> values = field.values(points);
        const std::vector<glm::dvec3> slopes = slopesAt(field, points, reach);
        for (std::size_t i = 0; i < points.size(); ++i) points[i] -= stepOf(values[i], slopes[i]);
    }
}

void makeTangent(const PointField& field, double reach, std::span<TangentPlane> planes) {
    std::vector<glm::dvec3> points;
    for (const TangentPlane& plane : planes) points.push_back(plane.point);
    const std::vector<double> values = field.values(points);
    const std::vector<glm::dvec3> slopes = slopesAt(field, points, reach);
    for (std::size_t i = 0; i < planes.size(); ++i)
        planes[i] = {points[i] - stepOf(values[i], slopes[i]), unitOr(slopes[i], planes[i].normal)};
}

}  // namespace edgewise::sdf
