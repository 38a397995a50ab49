#include "sdf/scene_trace.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/analytic_shape.h"
#include "sdf/evaluate.h"

namespace edgewise::sdf {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void count(const TraceHit& hit, const Tape& tape, TraceCounts* counts) {
    if (!counts) return;
    counts->rays += 1, counts->evaluations += hit.evaluations, counts->iterations += hit.iterations;
    counts->failed += hit.failed, counts->instructions += hit.evaluations * tape.size();
}

/// The ray from its end to its start.
FieldRay reversed(const FieldRay& ray, double t_end) {
    FieldRay back = ray;
    back.origin_world = ray.origin_world + ray.direction_world * t_end;
    back.direction_world = -ray.direction_world;
    back.t_min = 0.0, back.t_max = t_end - ray.t_min;
    back.pixel_radius = ray.pixel_radius + ray.pixel_slope * t_end;
    back.pixel_slope = -ray.pixel_slope;
    return back;
}

}  // namespace

TraceCounts& TraceCounts::operator+=(const TraceCounts& other) {
    rays += other.rays, evaluations += other.evaluations, iterations += other.iterations;
    failed += other.failed, instructions += other.instructions;
    return *this;
}

SceneTracer::SceneTracer(const FieldScene& scene, const Tape& tape, const TraceSettings& settings)
    : scene_(scene), tape_(tape), settings_(settings) {}

bool SceneTracer::withinBound(FieldRay& ray) const {
    if (!settings_.convex || !scene_.convex) return true;
    const auto [first, last] =
        meetSphere(ray.origin_world, ray.direction_world, scene_.convex->center_world, scene_.convex->radius);
    ray.t_min = std::max(ray.t_min, first), ray.t_max = std::min(ray.t_max, last);
    return ray.t_min < ray.t_max;
}

/// From within a convex solid what is met first from outside, backwards, is what would be met last.
TraceHit SceneTracer::traceField(const FieldRay& ray, double sign) const {
    FieldRay part = ray;
    if (!withinBound(part)) return {TraceEnd::kFar, ray.t_max, 0.0, 0, 0, 0};
    const bool through = sign < 0.0 && settings_.convex && scene_.convex && part.t_max < ray.t_max;
    if (!through) return traceRay(tape_, part, settings_, sign);
    TraceHit hit = traceRay(tape_, reversed(ray, part.t_max), settings_, 1.0);
    hit.t = part.t_max - hit.t;
    return hit;
}

void SceneTracer::meetField(const FieldRay& ray, FieldHit& nearest, TraceCounts* counts) const {
    FieldRay part = ray;
    part.t_max = std::min(ray.t_max, nearest.t);
    const double sign = valueAt(tape_, ray.origin_world) < 0.0 ? -1.0 : 1.0;
    TraceHit hit = traceField(part, sign);
    ++hit.evaluations;  // for the sign
    count(hit, tape_, counts);
    nearest.evaluations = hit.evaluations, nearest.iterations = hit.iterations;
    if (!hit.hit()) return;
    place(ray, hit, nearest);
    nearest.inside = sign < 0.0;
}

void SceneTracer::place(const FieldRay& ray, const TraceHit& hit, FieldHit& out) const {
    out.t = hit.t, out.value = hit.value;
    out.evaluations = hit.evaluations, out.iterations = hit.iterations;
    out.position_world = ray.origin_world + ray.direction_world * hit.t;
    out.normal_world = normalAt(out.position_world);
    out.material = materialAt(out.position_world);
    out.inside = false;
}

void SceneTracer::meetAnalytic(const FieldRay& ray, FieldHit& nearest) const {
    for (const AnalyticShape& shape : scene_.analytic) {
        const AnalyticMeeting met = meet(shape, ray);
        if (!(met.t < nearest.t)) continue;
        nearest = {};
        nearest.t = met.t;
        nearest.position_world = ray.origin_world + ray.direction_world * met.t;
        nearest.normal_world = met.normal_world, nearest.inside = met.inside;
        nearest.material = shape.material;
    }
}

FieldHit SceneTracer::nearest(const FieldRay& ray, TraceCounts* counts) const {
    FieldHit nearest;
    meetAnalytic(ray, nearest);
    if (tape_.size() > 0) meetField(ray, nearest, counts);
    return nearest;
}

bool SceneTracer::occluded(const FieldRay& ray, double distance, TraceCounts* counts) const {
    FieldRay part = ray;
    part.t_max = std::min(ray.t_max, distance);
    FieldHit nearest;
    meetAnalytic(part, nearest);
    if (nearest.hit()) return true;
    if (tape_.size() == 0 || !withinBound(part)) return false;
    const TraceHit hit = traceRay(tape_, part, settings_);
    count(hit, tape_, counts);
    return hit.hit();
}

double SceneTracer::secondaryOffset(const FieldHit& hit, double eye_distance) const {
    const double least = settings_.epsilon * std::max(eye_distance, 1e-3);
    return 2.0 * (settings_.dynamic_epsilon ? std::max(least, std::abs(hit.value)) : least);
}

std::uint32_t SceneTracer::materialAt(const glm::dvec3& p_world) const {
    glm::dvec3 local;
    const std::uint32_t material = winnerAt(tape_, p_world, local).material;
    const auto last = static_cast<std::uint32_t>(scene_.materials.size() - 1);
    return std::min(material, last);
}

glm::dvec3 SceneTracer::normalAt(const glm::dvec3& p_world) const {
    const glm::dvec3 gradient = gradientAt(tape_, p_world).gradient;
    const double length = glm::length(gradient);
    return length > 0.0 && length < kInfinity ? gradient / length : glm::dvec3(0.0, 1.0, 0.0);
}

}  // namespace edgewise::sdf
