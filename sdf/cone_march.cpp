#include "sdf/cone_march.h"

namespace edgewise::sdf {
namespace {

/// A cone that goes on by less than this part of its half width leaves the rest to narrower ones.
constexpr double kLeastGain = 0.5;

}  // namespace

ConeMarch::ConeMarch(const Beam& beam, double t_start, double t_max, Relaxation relaxation) : beam_(beam) {
    rules_.relaxation = static_cast<int>(relaxation);
    rules_.omega = 1.2;
    rules_.t_max = t_max;
    rules_.pixel_radius = beam.half_width, rules_.pixel_slope = beam.sine;
    rules_.threshold = kLeastGain;
    state_ = tracing::traceFrom(rules_, t_start);
}

void ConeMarch::take(double value) {
    ++evaluations_;
    state_ = tracing::traceTake(rules_, state_, beam_.freeAround(askedAt(), value));
}

}  // namespace edgewise::sdf
