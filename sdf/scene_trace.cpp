#include "sdf/scene_trace.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/analytic_shape.h"
#include "sdf/evaluate.h"
#include "sdf/pattern_point.h"

namespace edgewise::sdf {
namespace {

/// A cube around what the scene holds and where it is seen from, and some of what lies beyond.
std::shared_ptr<const CellTapes> cellsOf(const FieldScene& scene, const Tape& tape, bool prune) {
    glm::dvec3 low(scene.bounds.low[0], scene.bounds.low[1], scene.bounds.low[2]);
    glm::dvec3 high(scene.bounds.high[0], scene.bounds.high[1], scene.bounds.high[2]);
    for (const SurfaceCamera& camera : scene.cameras)
        low = glm::min(low, camera.eye_world), high = glm::max(high, camera.eye_world);
    const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    const double half = std::max(2.0 * size, std::min(scene.far, 32.0 * size));
    return std::make_shared<const CellTapes>(tape, 0.5 * (low + high), half,
                                             prune && scene.bound_holds && std::isfinite(half));
}

}  // namespace

TraceSettings trustedSettings(const FieldScene& scene, TraceSettings settings) {
    if (scene.bound_holds) return settings;
    settings.relaxation = Relaxation::kNone;
    settings.prepass = settings.prune = false;
    return settings;
}

SceneTracer::SceneTracer(const FieldScene& scene, const Tape& tape, const TraceSettings& settings)
    : scene_(scene), tape_(tape), settings_(settings), cells_(cellsOf(scene, tape, settings.prune)) {}

bool SceneTracer::withinBound(FieldRay& ray) const {
    if (!settings_.convex || !scene_.convex) return true;
    const auto [first, last] =
        meetSphere(ray.origin_world, ray.direction_world, scene_.convex->center_world, scene_.convex->radius);
    ray.t_min = std::max(ray.t_min, first), ray.t_max = std::min(ray.t_max, last);
    return ray.t_min < ray.t_max;
}

FieldRay SceneTracer::reversed(const FieldRay& ray, double t_end) {
    FieldRay back = ray;
    back.origin_world = ray.origin_world + ray.direction_world * t_end;
    back.direction_world = -ray.direction_world;
    back.t_min = 0.0, back.t_max = t_end - ray.t_min;
    back.pixel_radius = ray.pixel_radius + ray.pixel_slope * t_end;
    back.pixel_slope = -ray.pixel_slope;
    return back;
}

bool SceneTracer::backwards(const FieldRay& ray, const FieldRay& part, double sign) const {
    return sign < 0.0 && settings_.convex && scene_.convex && part.t_max < ray.t_max;
}

TraceHit SceneTracer::traceField(const FieldRay& ray, double sign) const {
    FieldRay part = ray;
    if (!withinBound(part)) return {TraceEnd::kFar, ray.t_max, 0.0, 0, 0, 0};
    if (!backwards(ray, part, sign)) return traceRay(*cells_, part, settings_, sign);
    TraceHit hit = traceRay(*cells_, reversed(ray, part.t_max), settings_, 1.0);
    hit.t = part.t_max - hit.t;
    return hit;
}

SurfaceHit SceneTracer::fieldHit(const FieldRay& ray, const TraceHit& hit, double sign) const {
    SurfaceHit out;
    out.evaluations = hit.evaluations, out.iterations = hit.iterations;
    if (!hit.hit()) return out;
    out.hit = true, out.inside = sign < 0.0;
    out.t = hit.t, out.value = hit.value;
    out.p_world = ray.origin_world + ray.direction_world * hit.t;
    describeHit(cells_->at(out.p_world).tape, out, scene_.materials.size());
    return out;
}

void SceneTracer::meetAnalytic(const FieldRay& ray, SurfaceHit& nearest) const {
    for (std::size_t i = 0; i < scene_.analytic.size(); ++i) {
        const AnalyticShape& shape = scene_.analytic[i];
        const AnalyticMeeting met = meet(shape, ray);
        if (!(met.t <= ray.t_max) || (nearest.hit && met.t >= nearest.t)) continue;
        nearest.hit = true, nearest.shape = static_cast<std::uint32_t>(i);
        nearest.inside = met.inside, nearest.t = met.t, nearest.value = 0.0;
        nearest.p_world = ray.origin_world + ray.direction_world * met.t;
        nearest.normal_world = met.normal_world, nearest.material = shape.material;
        nearest.p_local = patternPoint(shape, nearest.p_world, met.t);
    }
}

SurfaceHit SceneTracer::nearest(const FieldRay& ray, double sign) const {
    SurfaceHit analytic;
    meetAnalytic(ray, analytic);
    if (tape_.size() == 0) return analytic;
    FieldRay part = ray;
    if (analytic.hit) part.t_max = analytic.t;
    const SurfaceHit field = fieldHit(ray, traceField(part, sign), sign);
    if (field.hit) return field;
    analytic.evaluations = field.evaluations, analytic.iterations = field.iterations;
    return analytic;
}

bool SceneTracer::occluded(const FieldRay& ray, double sign, std::uint64_t& evaluations) const {
    SurfaceHit analytic;
    meetAnalytic(ray, analytic);
    if (analytic.hit || tape_.size() == 0) return analytic.hit;
    const TraceHit hit = traceField(ray, sign);
    evaluations += hit.evaluations;
    return hit.hit();
}

double SceneTracer::signAt(const glm::dvec3& p_world) const {
    return tape_.size() > 0 && valueAt(tape_, p_world) < 0.0 ? -1.0 : 1.0;
}

}  // namespace edgewise::sdf
