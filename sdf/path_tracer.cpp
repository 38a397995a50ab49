#include "sdf/path_tracer.h"

#include <utility>

#include "sdf/shading_text.h"

namespace edgewise::sdf {
namespace {

/// A shadow ray ends this part of its way before the lamp: rounding must not let the lamp shade itself.
constexpr double kBeforeLamp = 1.0 - 1e-9;

/// Where a ray enters a sphere that it surely meets, being sampled within its cone.
double entry(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& center, double radius) {
    const glm::dvec3 way = center - origin;
    const double along = dot(way, direction);
    const glm::dvec3 across = way - direction * along;
    return along - std::sqrt(std::max(radius * radius - dot(across, across), 0.0));
}

}  // namespace

struct PathTracer::Path {
    TravellingRay way;
    glm::dvec3 throughput{1.0};
    glm::dvec3 sum{0.0};
    double density =
        0.0;          ///< of the way's direction, where it was scattered; 0: mirrored, refracted, or first
    int surface = 0;  ///< on the path
    bool ended = false;
};

PathTracer::PathTracer(ShadingSettings settings, const std::vector<AnalyticShape>& shapes,
                       const SurfaceTracer& tracer, PathSettings path)
    : settings_(std::move(settings)), tracer_(tracer), path_(path) {
    for (std::uint32_t i = 0; i < shapes.size() && path.next_event; ++i) {
        const AnalyticShape& shape = shapes[i];
        const glm::dvec3 radiance = settings_.materials[shape.material].emission;
        if (shape.type == AnalyticShape::Type::kSphere && radiance != glm::dvec3(0.0))
            lamps_.push_back({i, shape.center_world, shape.radius, radiance});
    }
    pairs_ = static_cast<std::uint32_t>(2 + lamps_.size());
}

glm::dvec4 PathTracer::radiance(const FieldRay& ray, PathSampler& sampler, RayCounts& counts,
                                double sign) const {
    return radiance(ray, tracer_.nearest(ray, sign), sampler, counts, sign);
}

glm::dvec4 PathTracer::radiance(const FieldRay& ray, const SurfaceHit& first, PathSampler& sampler,
                                RayCounts& counts, double sign) const {
    Path path{{ray, sign}};
    ++counts.primary;
    for (SurfaceHit hit = first;; hit = tracer_.nearest(path.way.ray, path.way.sign)) {
        counts.evaluations += hit.evaluations;
        if (!hit.hit) {
            path.sum += path.throughput * settings_.background;
            break;
        }
        step(path, hit, sampler, counts);
        if (path.ended) break;
    }
    return {path.sum, first.hit ? 1.0 : 0.0};
}

/// What a surface sends along the path by itself: less where fromLamp() has asked for it too.
glm::dvec3 PathTracer::met(const Path& path, const SurfaceHit& hit) const {
    const glm::dvec3 emission = settings_.materials[hit.material].emission;
    if (path.density == 0.0 || hit.inside) return emission;
    for (const Lamp& lamp : lamps_) {
        if (lamp.shape != hit.shape) continue;
        const double distance = length(lamp.center_world - path.way.ray.origin_world);
        const double density = shading::coneDensity(shading::versineOfSphere(lamp.radius, distance));
        return emission * shading::sharedWeight(path.density, density);
    }
    return emission;
}

void PathTracer::step(Path& path, const SurfaceHit& hit, PathSampler& sampler, RayCounts& counts) const {
    if (path.way.medium != kNoMaterial)
        path.throughput *= shading::absorbed(settings_.materials[path.way.medium].absorption, hit.t);
    path.sum += path.throughput * met(path, hit);
    path.ended = path.surface == path_.depth;
    if (path.ended) return;
    const SurfacePoint point = surfacePoint(settings_, path.way, hit);
    const glm::dvec3 shares = sharesOf(point);
    const glm::dvec2 random = sampler.pair(path.surface * pairs_);
    if (random.x < shares.x) {
        scatter(path, hit, point, sampler, counts);
    } else {
        const glm::dvec3 direction = path.way.ray.direction_world;
        const bool mirrors = random.x < shares.x + shares.y || shares.z == 0.0;
        path.density = 0.0;
        ++(mirrors ? counts.reflection : counts.refraction);
        path.way = mirrors
                       ? rayFrom(settings_, path.way, hit, point, shading::mirrored(direction, point.normal))
                       : rayThrough(settings_, path.way, hit, point,
                                    shading::refracted(direction, point.normal, point.eta));
    }
    ++path.surface;
    if (path.ended || path.surface <= path_.roulette_after) return;
    const double survives =
        std::min(1.0, std::max(path.throughput.x, std::max(path.throughput.y, path.throughput.z)));
    path.ended = random.y >= survives;
    if (!path.ended) path.throughput /= survives;
}

void PathTracer::scatter(Path& path, const SurfaceHit& hit, const SurfacePoint& point, PathSampler& sampler,
                         RayCounts& counts) const {
    path.ended = point.material->shading == SurfaceMaterial::Shading::kUnlit;
    if (path.ended) {
        path.sum += path.throughput * point.color;
        return;
    }
    const std::uint32_t first = path.surface * pairs_ + 1;
    const glm::dvec2 random = sampler.pair(first);
    const glm::dvec3 direction = shading::cosineDirection(point.normal, random.x, random.y);
    const TravellingRay out = rayFrom(settings_, path.way, hit, point, direction);
    path.sum += fromLights(path, out, point, counts);
    for (std::uint32_t i = 0; i < lamps_.size(); ++i)
        path.sum += fromLamp(lamps_[i], path, out, point, sampler.pair(first + 1 + i), counts);
    const double cosine = shading::cosineTowards(point.normal, direction);
    path.ended = cosine == 0.0;
    path.throughput *= scatteredShare(point, direction) * M_PI;
    path.density = shading::cosineDensity(cosine);
    path.way = out;
    ++counts.scattered;
}

glm::dvec3 PathTracer::fromLights(const Path& path, const TravellingRay& out, const SurfacePoint& point,
                                  RayCounts& counts) const {
    glm::dvec3 sum(0.0);
    for (const SurfaceLight& light : settings_.lights) {
        FieldRay ray = out.ray;
        const LightArrival arrival = arrivalOf(light, ray.origin_world);
        const double cosine = shading::cosineTowards(point.normal, arrival.towards);
        if (cosine == 0.0 || arrival.illuminance == glm::dvec3(0.0)) continue;
        ray.direction_world = arrival.towards;
        ray.t_max = std::min(settings_.far, arrival.distance);
        if (light.shadows && ++counts.shadow && tracer_.occluded(ray, out.sign, counts.evaluations)) continue;
        sum += scatteredShare(point, arrival.towards) * arrival.illuminance * cosine;
    }
    return path.throughput * sum;
}

glm::dvec3 PathTracer::fromLamp(const Lamp& lamp, const Path& path, const TravellingRay& out,
                                const SurfacePoint& point, glm::dvec2 random, RayCounts& counts) const {
    FieldRay ray = out.ray;
    const glm::dvec3 way = lamp.center_world - ray.origin_world;
    const double distance = length(way);
    if (distance <= lamp.radius) return glm::dvec3(0.0);
    const double versine = shading::versineOfSphere(lamp.radius, distance);
    ray.direction_world = shading::coneDirection(way / distance, versine, random.x, random.y);
    const double cosine = shading::cosineTowards(point.normal, ray.direction_world);
    if (cosine == 0.0) return glm::dvec3(0.0);
    ray.t_max = kBeforeLamp * entry(ray.origin_world, ray.direction_world, lamp.center_world, lamp.radius);
    ++counts.shadow;
    if (ray.t_max > settings_.far || tracer_.occluded(ray, out.sign, counts.evaluations))
        return glm::dvec3(0.0);
    const double density = shading::coneDensity(versine);
    const double weight = shading::sharedWeight(density, shading::cosineDensity(cosine));
    return path.throughput * scatteredShare(point, ray.direction_world) * lamp.radiance *
           (cosine * weight / density);
}

}  // namespace edgewise::sdf
