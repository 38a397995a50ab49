#include "sdf/analytic_shape.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sdf/pattern_point.h"

namespace edgewise::sdf {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

AnalyticMeeting meetBall(const AnalyticShape& shape, const FieldRay& ray) {
    const auto [first, last] =
        meetSphere(ray.origin_world, ray.direction_world, shape.center_world, shape.radius);
    const bool inside = !(first >= ray.t_min);
    const double t = inside ? last : first;
    if (!(t >= ray.t_min && t <= ray.t_max)) return {kInfinity, {}, false};
    const glm::dvec3 p = ray.origin_world + ray.direction_world * t;
    return {t, glm::normalize(p - shape.center_world), inside};
}

AnalyticMeeting meetPlane(const AnalyticShape& shape, const FieldRay& ray) {
    const double fall = glm::dot(ray.direction_world, shape.normal_world);
    const double t = (shape.offset - glm::dot(ray.origin_world, shape.normal_world)) / fall;
    if (!(t >= ray.t_min && t <= ray.t_max)) return {kInfinity, {}, false};
    return {t, fall > 0.0 ? -shape.normal_world : shape.normal_world, false};
}

}  // namespace

/// About the point of the line nearest to the centre, so that far origins cancel nothing.
std::pair<double, double> meetSphere(const glm::dvec3& origin, const glm::dvec3& direction,
                                     const glm::dvec3& centre, double radius) {
    const glm::dvec3 to_centre = centre - origin;
    const double along = glm::dot(to_centre, direction);
    const glm::dvec3 off = to_centre - direction * along;
    const double rest = radius * radius - glm::dot(off, off);
    if (!(rest > 0.0)) return {kInfinity, -kInfinity};
    const double half = std::sqrt(rest);
    return {along - half, along + half};
}

AnalyticMeeting meet(const AnalyticShape& shape, const FieldRay& ray) {
    return shape.type == AnalyticShape::Type::kSphere ? meetBall(shape, ray) : meetPlane(shape, ray);
}

double heightOver(const AnalyticShape& shape, const glm::dvec3& p) {
    return shape.type == AnalyticShape::Type::kSphere ? length(p - shape.center_world) - shape.radius
                                                      : dot(p, shape.normal_world) - shape.offset;
}

glm::dvec3 patternPoint(const AnalyticShape& shape, const glm::dvec3& p, double t) {
    const double height = heightOver(shape, p);
    if (shape.type == AnalyticShape::Type::kPlane) return patternPoint(p, shape.normal_world, height, t);
    const glm::dvec3 outward = glm::normalize(p - shape.center_world);
    return patternPoint(p, outward, height, t) - shape.center_world;
}

}  // namespace edgewise::sdf
