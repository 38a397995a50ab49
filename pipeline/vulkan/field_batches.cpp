#include "pipeline/vulkan/field_batches.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "sdf/analytic_shape.h"
#include "sdf/describe_hits.h"

namespace edgewise::vulkan {
namespace {

constexpr std::size_t kTileRays = 64;

std::size_t wholeTiles(std::size_t rays) {
    return (rays + kTileRays - 1) / kTileRays * kTileRays;
}

template <class Work>
void eachTile(std::size_t rays, const Work& work) {
    tbb::parallel_for(std::size_t(0), wholeTiles(rays) / kTileRays, [&](std::size_t tile) {
        work(tile * kTileRays, std::min(rays, (tile + 1) * kTileRays));
    });
}

glm::dvec3 vectorOf(const float (&v)[3]) {
    return {v[0], v[1], v[2]};
}

}  // namespace

FieldBatches::FieldBatches(const sdf::FieldScene& scene, const sdf::Tape& tape, const FieldShaders& shaders,
                           const sdf::TraceSettings& settings, FieldRays* rays, const FieldSphere& around,
                           std::size_t most, std::function<bool()> cancelled)
    : scene_(scene),
      tape_(tape),
      shaders_(shaders),
      settings_(settings),
      rays_(rays),
      around_(around),
      lists_(std::isfinite(around.sphere.w) ? around.sphere : glm::dvec4(0.0, 0.0, 0.0, scene.far)),
      most_(most),
      cancelled_(std::move(cancelled)),
      closed_(scene, tape, settings) {}

double FieldSphere::lastT(const GpuRay& ray, double t_max, double reach) const {
    if (!std::isfinite(sphere.w)) return t_max;
    const auto [enters, leaves] =
        sdf::meetSphere(vectorOf(ray.origin), vectorOf(ray.direction), glm::dvec3(sphere), sphere.w);
    const double last = std::min(t_max, std::max(leaves, 0.0));
    const double radius = std::max<double>(ray.pixel_radius, ray.pixel_radius + ray.pixel_slope * last);
    return reach * radius <= level ? std::min(t_max, leaves) : t_max;
}

GpuRay FieldBatches::askWithin(const sdf::TravellingRay& ray, double reach) const {
    GpuRay made = gpuRay(ray.ray, ray.sign);
    made.t_max = static_cast<float>(around_.lastT(made, made.t_max, reach));
    return made.t_min < made.t_max ? made : GpuRay{};
}

GpuRay FieldBatches::ask(const sdf::TravellingRay& ray, Question& question) const {
    closed_.meetAnalytic(ray.ray, question.closed);
    sdf::FieldRay part = ray.ray;
    if (question.closed.hit) part.t_max = question.closed.t;
    const sdf::FieldRay whole = part;
    if (!closed_.withinBound(part)) return {};
    question.backwards = closed_.backwards(whole, part, ray.sign);
    question.t_end = part.t_max;
    GpuRay made = question.backwards ? gpuRay(sdf::SceneTracer::reversed(whole, part.t_max), 1.0)
                                     : gpuRay(part, ray.sign);
    made.t_max = static_cast<float>(around_.lastT(made, made.t_max, std::max(settings_.threshold, 1.0)));
    return made.t_min < made.t_max ? made : GpuRay{};
}

FieldAnswers FieldBatches::traceField(const std::vector<GpuRay>& rays, bool with_hits) {
    if (!rays_) return {};
    return rays_->trace(rays, lists_, cancelled_, with_hits);
}

sdf::SurfaceHit FieldBatches::answer(const sdf::TravellingRay& ray, const Question& question,
                                     const GpuRayState& state, const GpuHit& hit) const {
    sdf::SurfaceHit out = question.closed;
    out.evaluations = state.evaluations, out.iterations = state.iterations;
    if (!state.hit()) return out;
    out.hit = true, out.shape = sdf::SurfaceHit::kField;
    out.inside = question.backwards || state.sign < 0.0f;
    out.t = question.backwards ? question.t_end - hit.t : hit.t;
    out.value = static_cast<double>(hit.value) * state.sign * shaders_.lipschitz;
    out.p_world = ray.ray.origin_world + ray.ray.direction_world * out.t;
    if (scene_.glsl) takeMap(out, hit, state.sign);
    return out;
}

void FieldBatches::takeMap(sdf::SurfaceHit& hit, const GpuHit& of, double sign) const {
    hit.p_local = hit.p_world;
    hit.normal_world = glm::normalize(vectorOf(of.normal)) * sign;
    hit.material = static_cast<std::uint32_t>(scene_.materials.size() - 1);
    if (shaders_.user_albedo) hit.color = vectorOf(of.color);
}

sdf::SurfaceHit FieldBatches::surfaceAt(const sdf::TravellingRay& ray, double t) {
    sdf::SurfaceHit hit;
    hit.hit = true, hit.inside = ray.sign < 0.0, hit.t = t;
    hit.p_world = ray.ray.origin_world + ray.ray.direction_world * t;
    hit.value = NAN;
    return hit;
}

void FieldBatches::describeTree(std::span<sdf::SurfaceHit*> hits) const {
    if (tape_.size() > 0) sdf::describeHits(tape_, hits, scene_.materials.size(), settings_.prune);
}

void FieldBatches::describeMap(std::span<const sdf::TravellingRay> rays, std::span<sdf::SurfaceHit> hits) {
    for (std::size_t first = 0; first < rays.size(); first += most_) {
        const std::size_t count = std::min(most_, rays.size() - first);
        std::vector<GpuRay> asked(wholeTiles(count));
        std::vector<float> at(asked.size());
        for (std::size_t i = 0; i < count; ++i) {
            asked[i] = gpuRay(rays[first + i].ray, rays[first + i].sign);
            at[i] = static_cast<float>(hits[first + i].t);
        }
        const std::span<const GpuHit> found = rays_->describe(asked, at);
        for (std::size_t i = 0; i < count; ++i) {
            takeMap(hits[first + i], found[i], rays[first + i].sign);
            hits[first + i].value = 0.0;
        }
    }
}

void FieldBatches::nearestPart(std::span<const sdf::TravellingRay> rays, std::span<sdf::SurfaceHit> hits,
                               bool described) {
    std::vector<Question> questions(rays.size());
    std::vector<GpuRay> asked(wholeTiles(rays.size()));
    eachTile(rays.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) asked[i] = ask(rays[i], questions[i]);
    });
    const FieldAnswers answers = traceField(asked, true);
    eachTile(rays.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            hits[i] = rays_ ? answer(rays[i], questions[i], answers.states[i], answers.hits[i])
                            : questions[i].closed;
        if (!described) return;
        std::vector<sdf::SurfaceHit*> of_field;
        for (std::size_t i = first; i < last; ++i)
            if (hits[i].hit && hits[i].ofField()) of_field.push_back(&hits[i]);
        describeTree(of_field);
    });
}

void FieldBatches::occludedPart(std::span<const sdf::TravellingRay> rays, std::span<char> hidden) {
    std::vector<GpuRay> asked(wholeTiles(rays.size()));
    eachTile(rays.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            Question question;
            asked[i] = ask(rays[i], question);
            hidden[i] = question.closed.hit;
            if (question.closed.hit) asked[i] = {};
        }
    });
    const FieldAnswers answers = traceField(asked, false);
    for (std::size_t i = 0; rays_ && i < rays.size(); ++i) hidden[i] = hidden[i] || answers.states[i].hit();
}

std::vector<sdf::SurfaceHit> FieldBatches::nearest(std::span<const sdf::TravellingRay> rays) {
    std::vector<sdf::SurfaceHit> hits(rays.size());
    for (std::size_t first = 0; first < rays.size(); first += most_) {
        const std::size_t count = std::min(most_, rays.size() - first);
        nearestPart(rays.subspan(first, count), std::span(hits).subspan(first, count), true);
    }
    return hits;
}

std::vector<double> FieldBatches::depths(std::span<const sdf::TravellingRay> rays) {
    std::vector<double> depths(rays.size(), HUGE_VAL);
    std::vector<sdf::SurfaceHit> hits(std::min(most_, rays.size()));
    for (std::size_t first = 0; first < rays.size(); first += most_) {
        const std::size_t count = std::min(most_, rays.size() - first);
        nearestPart(rays.subspan(first, count), std::span(hits).first(count), false);
        for (std::size_t i = 0; i < count; ++i)
            if (hits[i].hit) depths[first + i] = hits[i].t;
    }
    return depths;
}

std::vector<sdf::SurfaceHit> FieldBatches::describe(std::span<const sdf::TravellingRay> rays,
                                                    std::span<const double> depths) {
    std::vector<sdf::SurfaceHit> hits(rays.size());
    eachTile(rays.size(), [&](std::size_t first, std::size_t last) {
        std::vector<sdf::SurfaceHit*> met;
        for (std::size_t i = first; i < last; ++i) {
            if (!std::isfinite(depths[i])) continue;
            hits[i] = surfaceAt(rays[i], depths[i]);
            met.push_back(&hits[i]);
        }
        describeTree(met);
    });
    if (!scene_.glsl) return hits;
    describeMap(rays, hits);
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (!std::isfinite(depths[i])) hits[i] = {};
    return hits;
}

std::vector<char> FieldBatches::occluded(std::span<const sdf::TravellingRay> rays) {
    std::vector<char> hidden(rays.size());
    for (std::size_t first = 0; first < rays.size(); first += most_) {
        const std::size_t count = std::min(most_, rays.size() - first);
        occludedPart(rays.subspan(first, count), std::span(hidden).subspan(first, count));
    }
    return hidden;
}

}  // namespace edgewise::vulkan
