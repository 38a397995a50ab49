#include "sdf/cone_trace.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>

namespace edgewise::sdf {
namespace {

constexpr double kSqrt2 = 1.41421356237309504880;
constexpr double kMaskBits = 32.0;

}  // namespace

cones::ConeRules coneRules(const FieldRay& ray, const TraceSettings& trace, const ConeSettings& settings) {
    cones::ConeRules rules{};
    const double scale = kSqrt2 * settings.coverage;
    rules.t_max = ray.t_max;
    rules.radius = scale * ray.pixel_radius;
    rules.slope = scale * ray.pixel_slope;
    rules.alpha = settings.alpha;
    // The same distance as where tracing without cones ends.
    rules.hard = trace.threshold / scale;
    rules.relaxed = settings.relaxed;
    rules.backtrace = settings.backtrace;
    rules.overstep = trace.relaxation != Relaxation::kNone;
    return rules;
}

ConeTrace::ConeTrace(const FieldRay& ray, const TraceSettings& trace, const ConeSettings& settings)
    : rules_(coneRules(ray, trace, settings)),
      state_(cones::coneFrom(rules_, ray.t_min)),
      most_steps_(static_cast<std::uint32_t>(trace.most_steps)) {}

void ConeTrace::take(double value) {
    state_ = cones::coneTake(rules_, state_, value);
    ++hits_.evaluations;
    if (hits_.evaluations >= most_steps_) state_ = cones::coneStopped(state_);
    if (state_.closed) keepGroup();
    hits_.full = state_.end == cones::kConeFull;
}

void ConeTrace::keepGroup() {
    const int at = std::min(hits_.count, ConeHits::kMostGroups - 1);
    hits_.groups[at] = {cones::coneSampleAt(state_), state_.entry_t, cones::coneLeast(state_), state_.hard};
    hits_.count = at + 1;
}

bool fillsMask(const ConeGroup& group, const ConeSettings& settings) {
    return (settings.relaxed && group.hard) || group.least <= -kSqrt2;
}

std::uint32_t groupMask(const ConeGroup& group, const glm::dvec3& normal_world, const glm::dvec3& right_world,
                        const glm::dvec3& down_world, const ConeSettings& settings) {
    if (fillsMask(group, settings)) return ~0u;
    return cones::planeMask(glm::dot(normal_world, right_world), glm::dot(normal_world, down_world),
                            group.least, settings.four_by_eight);
}

bool ConeBlend::open() const {
    return std::popcount(covered_) < settings_.visible;
}

void ConeBlend::add(std::uint32_t uncovered_bits, const glm::dvec4& color) {
    const double weight = settings_.uniform ? 1.0 : std::popcount(uncovered_bits) / kMaskBits;
    sum_ += weight * color;
    weight_ += weight;
    covered_ |= uncovered_bits;
}

bool ConeBlend::normalized() const {
    return settings_.normalize_sky || settings_.uniform || !open();
}

bool ConeBlend::skyShows() const {
    return normalized() ? weight_ == 0.0 : covered_ != ~0u;
}

glm::dvec4 ConeBlend::over(const glm::dvec4& sky) const {
    if (normalized()) return weight_ > 0.0 ? sum_ / weight_ : sky;
    return sum_ + (std::popcount(~covered_) / kMaskBits) * sky;
}

}  // namespace edgewise::sdf
