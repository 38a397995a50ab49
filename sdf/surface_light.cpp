#include "sdf/surface_light.h"

#include <cmath>
#include <limits>

#include "sdf/shading_text.h"

namespace edgewise::sdf {
namespace {

/// Rays end `far` from where they begin, or at a light.
FieldRay secondaryRay(const SurfacePoint& point, const glm::dvec3& origin, const glm::dvec3& direction,
                      double t_max) {
    return {origin, direction, 0.0, t_max, 0.0, point.sharpness};
}

bool reaches(const LightArrival& arrival, const ShadingSettings& settings, const SurfaceTracer& tracer,
             const TravellingRay& from, const SurfaceHit& hit, const SurfacePoint& point, RayCounts& counts) {
    const glm::dvec3 origin = hit.p_world + point.normal * point.offset;
    const FieldRay ray =
        secondaryRay(point, origin, arrival.towards, std::min(settings.far, arrival.distance));
    ++counts.shadow;
    return !tracer.occluded(ray, from.sign, counts.evaluations);
}

}  // namespace

bool showsSecondColor(const SurfaceMaterial& material, const glm::dvec3& p_local) {
    switch (material.pattern) {
        case SurfaceMaterial::Pattern::kChecker:
            return shading::checkerAt(p_local, material.pattern_size) > 0.5;
        case SurfaceMaterial::Pattern::kStripes:
            return shading::stripesAt(p_local, glm::normalize(material.pattern_axis), material.pattern_size) >
                   0.5;
        default:
            return false;
    }
}

RayCounts& RayCounts::operator+=(const RayCounts& other) {
    primary += other.primary, shadow += other.shadow, reflection += other.reflection;
    refraction += other.refraction, scattered += other.scattered, evaluations += other.evaluations;
    return *this;
}

ShadingSettings shadingOf(const FieldScene& scene, const TraceSettings& trace) {
    ShadingSettings settings;
    settings.materials = scene.materials;
    settings.lights = scene.lights;
    settings.ambient = scene.ambient;
    settings.background = scene.background.value_or(glm::dvec3(0.0));
    settings.far = scene.far;
    settings.reflections = scene.reflections;
    settings.refractions = scene.refractions;
    settings.epsilon = trace.epsilon;
    settings.dynamic_epsilon = trace.dynamic_epsilon;
    return settings;
}

SurfacePoint surfacePoint(const ShadingSettings& settings, const TravellingRay& from, const SurfaceHit& hit) {
    const SurfaceMaterial& material = settings.materials[hit.material];
    SurfacePoint point;
    point.material = &material;
    point.color = showsSecondColor(material, hit.p_local) ? material.second_color : material.color;
    if (hit.color) point.color = *hit.color;
    point.normal = hit.inside ? -hit.normal_world : hit.normal_world;
    point.view = -from.ray.direction_world;
    point.eta = hit.inside ? 1.0 / material.ior : material.ior;
    const double from_eye = from.travelled + hit.t;
    const double least = settings.epsilon * from_eye;
    point.offset = shading::dynamicOffset(least, settings.dynamic_epsilon ? hit.value : 0.0);
    const double radius = from.ray.pixel_radius + from.ray.pixel_slope * hit.t;
    point.sharpness = hit.t > 0.0 ? radius / hit.t : from.ray.pixel_slope;
    return point;
}

glm::dvec3 sharesOf(const SurfacePoint& point) {
    const double cosine = std::max(dot(point.normal, point.view), 0.0);
    const double mirror = shading::mirrorShare(point.material->reflectance, cosine);
    const double transmittance = point.material->transmittance;
    const double fresnel = transmittance > 0.0 ? shading::fresnelShare(cosine, point.eta) : 0.0;
    return shading::surfaceShares(mirror, transmittance, fresnel);
}

glm::dvec3 scatteredShare(const SurfacePoint& point, const glm::dvec3& towards) {
    const SurfaceMaterial& material = *point.material;
    if (material.shading != SurfaceMaterial::Shading::kBlinnPhong) return shading::lambertShare(point.color);
    return shading::blinnPhongShare(point.color, material.specular, material.shininess, point.normal,
                                    point.view, towards);
}

LightArrival arrivalOf(const SurfaceLight& light, const glm::dvec3& p_world) {
    LightArrival arrival{-light.direction_world, light.color * light.intensity,
                         std::numeric_limits<double>::infinity()};
    if (light.type == SurfaceLight::Type::kDirectional) return arrival;
    const glm::dvec3 way = light.position_world - p_world;
    arrival.distance = length(way);
    arrival.towards = arrival.distance > 0.0 ? way / arrival.distance : glm::dvec3(0.0);
    arrival.illuminance *= shading::pointFalloff(arrival.distance);
    return arrival;
}

TravellingRay rayFrom(const ShadingSettings& settings, const TravellingRay& from, const SurfaceHit& hit,
                      const SurfacePoint& point, const glm::dvec3& direction) {
    const glm::dvec3 origin = hit.p_world + point.normal * point.offset;
    return {secondaryRay(point, origin, direction, settings.far), from.sign, from.medium,
            from.travelled + hit.t};
}

TravellingRay rayThrough(const ShadingSettings& settings, const TravellingRay& from, const SurfaceHit& hit,
                         const SurfacePoint& point, const glm::dvec3& direction) {
    const glm::dvec3 origin = hit.p_world - point.normal * point.offset;
    return {secondaryRay(point, origin, direction, settings.far), hit.ofField() ? -from.sign : from.sign,
            hit.inside ? kNoMaterial : hit.material, from.travelled + hit.t};
}

glm::dvec3 litBy(const ShadingSettings& settings, const SurfaceTracer& tracer, const TravellingRay& from,
                 const SurfaceHit& hit, const SurfacePoint& point, RayCounts& counts) {
    if (point.material->shading == SurfaceMaterial::Shading::kUnlit) return point.color;
    glm::dvec3 sum = settings.ambient * point.color;
    for (const SurfaceLight& light : settings.lights) {
        const LightArrival arrival = arrivalOf(light, hit.p_world);
        const double cosine = shading::cosineTowards(point.normal, arrival.towards);
        if (cosine == 0.0 || arrival.illuminance == glm::dvec3(0.0)) continue;
        if (light.shadows && !reaches(arrival, settings, tracer, from, hit, point, counts)) continue;
        sum += scatteredShare(point, arrival.towards) * arrival.illuminance * cosine;
    }
    return sum;
}

}  // namespace edgewise::sdf
