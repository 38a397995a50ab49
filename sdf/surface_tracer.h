// What shading asks of tracing: the nearest surface along a ray, and whether there is one at all.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "sdf/sphere_trace.h"

namespace edgewise::sdf {

/// Where a ray meets the field or an analytic shape.
struct SurfaceHit {
    static constexpr std::uint32_t kField = 0xffffffffu;
    bool hit = false;
    std::uint32_t shape = kField;  ///< of FieldScene::analytic
    bool inside = false;           ///< the ray comes from within the solid
    double t = 0.0;                ///< along the ray
    glm::dvec3 p_world{0.0};
    glm::dvec3 normal_world{0.0};  ///< unit, out of the solid; planes: on the ray's side
    glm::dvec3 p_local{0.0};  ///< where patterns are asked (pattern_point.h), in the winning shape's frame
    std::uint32_t material = 0;
    std::optional<glm::dvec3> color;  ///< in place of the material's
    double value = 0.0;               ///< the field's there; analytic shapes: 0
    double height = 0.0;              ///< above the surface: value over slope
    std::uint32_t evaluations = 0, iterations = 0;
    bool ofField() const { return shape == kField; }
};

/// `sign` is -1 for rays that are within the field's solid. Safe for many threads at once.
class SurfaceTracer {
  public:
    virtual ~SurfaceTracer() = default;
    virtual SurfaceHit nearest(const FieldRay& ray, double sign) const = 0;
    /// Whether anything is met before ray.t_max; adds the evaluations that it takes.
    virtual bool occluded(const FieldRay& ray, double sign, std::uint64_t& evaluations) const = 0;
};

}  // namespace edgewise::sdf
