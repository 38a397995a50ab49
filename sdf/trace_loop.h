// One ray's way through a field, whoever evaluates it: steps, then the hit's evening out.
#pragma once

#include "sdf/sphere_trace.h"
#include "sdf/trace_step.h"

namespace edgewise::sdf {

/// The shared text's rules for a ray.
tracing::TraceRules traceRules(const FieldRay& ray, const TraceSettings& settings);

/// Ask the field at askedAt() and take() what it says, as long as it asks.
class RayTrace {
  public:
    RayTrace(const FieldRay& ray, const TraceSettings& settings);

    bool asks() const { return phase_ != Phase::kDone; }
    double askedAt() const { return phase_ == Phase::kEvens ? even_t_ : tracing::traceAt(state_); }
    /// f / L, times the ray's sign.
    void take(double value);
    /// `scale`: what the values were divided by, L times the sign.
    TraceHit hit(double scale) const;

  private:
    enum class Phase : unsigned char { kSteps, kEvens, kDone };
    void step(double value);
    void even(double value);
    void end();
    void endWithoutSteps();

    const TraceSettings& settings_;
    tracing::TraceRules rules_;
    tracing::TraceState state_;
    TraceHit hit_;
    double even_t_ = 0.0;
    int evened_ = 0;
    Phase phase_ = Phase::kSteps;
};

}  // namespace edgewise::sdf
