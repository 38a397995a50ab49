// What every device says of an SDF scene in its plan.
#pragma once

#include <vector>

#include "pipeline/methods/method.h"
#include "sdf/field_scene.h"
#include "sdf/trace_settings.h"

namespace edgewise {

/// Why what rests on the field's bound is left out where that does not hold.
inline constexpr const char* kBoundBroken = "the field changes faster than its bound says";

/// Adds the entries `convex` and `analytic`.
void addClosedForms(const sdf::FieldScene& scene, const sdf::TraceSettings& settings,
                    std::vector<PlanEntry>& plan);

/// What a tracer of it would do by default, before any ray.
std::vector<PlanEntry> fieldPlan(const sdf::FieldScene& scene);

}  // namespace edgewise
