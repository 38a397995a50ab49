// Rays against the shapes that are met in closed form.
#pragma once

#include <utility>

#include "sdf/field_scene.h"
#include "sdf/sphere_trace.h"

namespace edgewise::sdf {

/// Where a line enters and leaves a ball; infinite and the wrong way round where it misses it.
std::pair<double, double> meetSphere(const glm::dvec3& origin_world, const glm::dvec3& direction_world,
                                     const glm::dvec3& centre_world, double radius);

struct AnalyticMeeting {
    double t;                 ///< infinite: none between the ray's t_min and t_max
    glm::dvec3 normal_world;  ///< unit; of spheres outward, of planes on the ray's side
    bool inside;              ///< the ray comes from within a sphere
};
AnalyticMeeting meet(const AnalyticShape& shape, const FieldRay& ray);

/// How far a point is outside; negative: within.
double heightOver(const AnalyticShape& shape, const glm::dvec3& p_world);
/// Where the pattern of a hit is asked, in the shape's frame: from a sphere's centre; of planes the world's.
glm::dvec3 patternPoint(const AnalyticShape& shape, const glm::dvec3& p_world, double t);

}  // namespace edgewise::sdf
