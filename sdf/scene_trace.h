// The nearest surface of a whole SDF scene along a ray: the field by sphere tracing, the analytic shapes in
// closed form.
#pragma once

#include "sdf/cell_tapes.h"
#include "sdf/field_scene.h"
#include "sdf/surface_tracer.h"
#include "sdf/tape.h"
#include "sdf/trace_settings.h"

namespace edgewise::sdf {

/// The settings without what rests on the field's bound, where the scene says that it does not hold:
/// relaxation, cones before rays, shorter tapes.
TraceSettings trustedSettings(const FieldScene& scene, TraceSettings settings);

/// Refers to the scene and the tape, which outlive it. From many threads at once.
class SceneTracer : public SurfaceTracer {
  public:
    /// `tape`: the scene's tree lowered; an empty one where the scene has no tree.
    SceneTracer(const FieldScene& scene, const Tape& tape, const TraceSettings& settings);

    /// Between the ray's t_min and t_max.
    SurfaceHit nearest(const FieldRay& ray, double sign) const override;
    bool occluded(const FieldRay& ray, double sign, std::uint64_t& evaluations) const override;

    /// The field alone, by the convex shortcut where the scene has it.
    TraceHit traceField(const FieldRay& ray, double sign) const;
    /// Shortens a ray to the convex bound, if the scene has one; false: it misses it, and so the field.
    bool withinBound(FieldRay& ray) const;
    /// From within a convex solid what is met first from outside, backwards, is what would be met last:
    /// whether `part`, the ray within the bound, is traced backwards, with sign 1.
    bool backwards(const FieldRay& ray, const FieldRay& part, double sign) const;
    /// The ray from its end to its start.
    static FieldRay reversed(const FieldRay& ray, double t_end);
    /// The closed forms' nearest, where it is nearer than `nearest`.
    void meetAnalytic(const FieldRay& ray, SurfaceHit& nearest) const;
    /// What is known of a hit of the field: where it is, its normal, and of the tree's winning branch the
    /// material.
    SurfaceHit fieldHit(const FieldRay& ray, const TraceHit& hit, double sign) const;

    /// -1 within the field's solid.
    double signAt(const glm::dvec3& p_world) const;

    /// The tape's shorter forms where they pay.
    const CellTapes& cells() const { return *cells_; }

  private:
    const FieldScene& scene_;
    const Tape& tape_;
    TraceSettings settings_;
    std::shared_ptr<const CellTapes> cells_;
};

}  // namespace edgewise::sdf
