#include "sdf/trace_loop.h"

namespace edgewise::sdf {

tracing::TraceRules traceRules(const FieldRay& ray, const TraceSettings& settings) {
    tracing::TraceRules rules{};
    rules.relaxation = static_cast<int>(settings.relaxation);
    rules.omega = settings.omega;
    rules.t_max = ray.t_max;
    rules.pixel_radius = ray.pixel_radius;
    rules.pixel_slope = ray.pixel_slope;
    rules.threshold = settings.threshold;
    rules.lift = settings.level_set ? settings.threshold : 0.0;
    return rules;
}

static_assert(static_cast<int>(Relaxation::kNone) == tracing::kRelaxNone &&
              static_cast<int>(Relaxation::kKeinert) == tracing::kRelaxKeinert &&
              static_cast<int>(Relaxation::kBalint) == tracing::kRelaxBalint &&
              static_cast<int>(Relaxation::kAuto) == tracing::kRelaxAuto);

RayTrace::RayTrace(const FieldRay& ray, const TraceSettings& settings)
    : settings_(settings), rules_(traceRules(ray, settings)), state_(tracing::traceFrom(rules_, ray.t_min)) {
    hit_.t = ray.t_min;
    if (tracing::traceEnded(state_)) phase_ = Phase::kDone;
}

void RayTrace::take(double value) {
    ++hit_.evaluations;
    if (phase_ == Phase::kEvens)
        even(value);
    else
        step(value);
}

void RayTrace::step(double value) {
    ++hit_.iterations;
    state_ = tracing::traceTake(rules_, state_, value);
    if (tracing::traceEnded(state_))
        end();
    else if (hit_.iterations >= static_cast<std::uint32_t>(settings_.most_steps))
        endWithoutSteps();
}

void RayTrace::end() {
    phase_ = Phase::kDone;
    hit_.t = state_.t, hit_.value = state_.value;
    hit_.end = state_.end == tracing::kRayHit ? TraceEnd::kSurface : TraceEnd::kFar;
    if (!hit_.hit() || settings_.discontinuity_steps == 0) return;
    phase_ = Phase::kEvens;
    even_t_ = tracing::evenedT(rules_, hit_.t, hit_.value);
}

/// The last point stands for the surface as it always did, however far it is from one; the nearest on the
/// screen where half a pixel holds it.
void RayTrace::endWithoutSteps() {
    phase_ = Phase::kDone;
    hit_.t = state_.t, hit_.value = state_.value, hit_.end = TraceEnd::kCandidate;
    if (!settings_.screen_candidate) return;
    hit_.t = state_.candidate_t, hit_.value = state_.candidate_value;
    if (!(state_.candidate_error <= 1.0)) hit_.end = TraceEnd::kOutOfSteps;
}

void RayTrace::even(double value) {
    hit_.t = even_t_, hit_.value = value;
    if (++evened_ == settings_.discontinuity_steps)
        phase_ = Phase::kDone;
    else
        even_t_ = tracing::evenedT(rules_, hit_.t, hit_.value);
}

TraceHit RayTrace::hit(double scale) const {
    TraceHit result = hit_;
    result.value *= scale;
    result.failed = static_cast<std::uint32_t>(state_.failed);
    return result;
}

}  // namespace edgewise::sdf
