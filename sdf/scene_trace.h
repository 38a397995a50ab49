// The nearest surface of a whole SDF scene along a ray: the field by sphere tracing, the analytic shapes in
// closed form.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

#include "sdf/field_scene.h"
#include "sdf/sphere_trace.h"

namespace edgewise::sdf {

/// Of one ray, or summed over many.
struct TraceCounts {
    std::uint64_t rays = 0;
    std::uint64_t evaluations = 0;   ///< of the field
    std::uint64_t iterations = 0;    ///< when the rays ended
    std::uint64_t failed = 0;        ///< relaxed steps taken back
    std::uint64_t instructions = 0;  ///< of tapes, run for the evaluations
    TraceCounts& operator+=(const TraceCounts& other);
};

struct FieldHit {
    double t = std::numeric_limits<double>::infinity();  ///< infinite: nothing is hit
    glm::dvec3 position_world{0.0};
    glm::dvec3 normal_world{0.0};  ///< unit, outward: away from the solid; of planes along their normal
    std::uint32_t material = 0;    ///< into FieldScene::materials
    double value = 0.0;            ///< the field's at the position, of analytic shapes 0
    bool inside = false;           ///< the ray came from within the solid: its side is -normal
    std::uint32_t evaluations = 0, iterations = 0;
    bool hit() const { return t < std::numeric_limits<double>::infinity(); }
};

/// Refers to the scene and the tape, which outlive it. From many threads at once.
class SceneTracer {
  public:
    /// `tape`: the scene's tree lowered; an empty one where the scene has no tree.
    SceneTracer(const FieldScene& scene, const Tape& tape, const TraceSettings& settings);

    /// Between the ray's t_min and t_max, from whichever side of the solid the ray starts on. `counts` may be
    /// null.
    FieldHit nearest(const FieldRay& ray, TraceCounts* counts = nullptr) const;
    /// Whether anything lies between the ray's t_min and `distance`.
    bool occluded(const FieldRay& ray, double distance, TraceCounts* counts = nullptr) const;

    /// Shortens a ray to the convex bound, if the scene has one; false: it misses it, and so the field.
    bool withinBound(FieldRay& ray) const;
    /// The closed form's nearest, where it is nearer than `nearest`.
    void meetAnalytic(const FieldRay& ray, FieldHit& nearest) const;
    /// What is known of a hit of the field beyond where it is.
    void place(const FieldRay& ray, const TraceHit& hit, FieldHit& out) const;

    /// How far a secondary ray starts from a hit along the normal (section 3.3): 2 max(epsilon, |f|).
    /// `eye_distance`: what the settings' epsilon is relative to.
    double secondaryOffset(const FieldHit& hit, double eye_distance) const;

    /// What a field's hit at a position is made of: the material of the tree's winning branch, and the
    /// normal.
    std::uint32_t materialAt(const glm::dvec3& p_world) const;
    glm::dvec3 normalAt(const glm::dvec3& p_world) const;

    const FieldScene& scene() const { return scene_; }
    const Tape& tape() const { return tape_; }
    const TraceSettings& settings() const { return settings_; }

  private:
    void meetField(const FieldRay& ray, FieldHit& nearest, TraceCounts* counts) const;
    TraceHit traceField(const FieldRay& ray, double sign) const;

    const FieldScene& scene_;
    const Tape& tape_;
    TraceSettings settings_;
};

}  // namespace edgewise::sdf
