// A beam's way through the field, up to where some ray of it may meet a surface.
#pragma once

#include "sdf/beam.h"
#include "sdf/trace_settings.h"
#include "sdf/trace_step.h"

namespace edgewise::sdf {

class ConeMarch {
  public:
    /// From where the beam is known to be free. It steps as rays do, the sphere's radius being how far up
    /// and down the axis the field's ball holds the whole beam; it ends where that is too little.
    ConeMarch(const Beam& beam, double t_start, double t_max, Relaxation relaxation);

    bool asks() const { return !tracing::traceEnded(state_) && evaluations_ < kMostEvaluations; }
    double askedAt() const { return tracing::traceAt(state_); }
    glm::dvec3 askedPoint() const { return beam_.at(askedAt()); }
    double radius() const { return beam_.half_width + beam_.sine * askedAt(); }
    /// f / L, times the rays' sign.
    void take(double value);

    /// No ray meets anything before it.
    double freeUpTo() const { return state_.t + std::max(state_.radius, 0.0); }
    bool empty() const { return state_.end == tracing::kRayFar; }
    int evaluations() const { return evaluations_; }

  private:
    static constexpr int kMostEvaluations = 64;
    Beam beam_;
    tracing::TraceRules rules_{};
    tracing::TraceState state_;
    int evaluations_ = 0;
};

}  // namespace edgewise::sdf
