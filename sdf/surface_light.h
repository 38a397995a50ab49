// What lights a surface, and what a surface is made of at a point.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sdf/field_scene.h"
#include "sdf/surface_tracer.h"

namespace edgewise::sdf {

/// All that shading needs of a scene beside its surfaces.
struct ShadingSettings {
    std::vector<SurfaceMaterial> materials;
    std::vector<SurfaceLight>
        lights;                  ///< never the default rig by themselves: whoever knows the camera adds it
    glm::dvec3 ambient{0.0};     ///< times a surface's colour
    glm::dvec3 background{0.0};  ///< what rays bring that meet nothing
    double far = 1000.0;         ///< secondary rays end here
    int reflections = 2, refractions = 8;
    double epsilon = 1e-6;        ///< TraceSettings::epsilon
    bool dynamic_epsilon = true;  ///< TraceSettings::dynamic_epsilon
};
/// Materials, ambient light, bounces and lights of a scene.
ShadingSettings shadingOf(const FieldScene& scene, const TraceSettings& trace);

/// Which of a pattern's two colours is seen at a place in the shape's frame.
bool showsSecondColor(const SurfaceMaterial& material, const glm::dvec3& p_local);

/// Rays by what they are for.
struct RayCounts {
    std::uint64_t primary = 0, shadow = 0, reflection = 0, refraction = 0, scattered = 0;
    std::uint64_t evaluations = 0;  ///< of the field, by all of them
    RayCounts& operator+=(const RayCounts& other);
};

/// A ray on its way through a scene.
struct TravellingRay {
    FieldRay ray;
    double sign = 1.0;                   ///< -1: within the field's solid
    std::uint32_t medium = kNoMaterial;  ///< of the solid that it is in; solids of glass do not nest
    double travelled = 0.0;              ///< from the eye to the ray's origin
};

/// The point of a surface that a ray has met, on the ray's side.
struct SurfacePoint {
    const SurfaceMaterial* material;
    glm::dvec3 color;   ///< of the pattern
    glm::dvec3 normal;  ///< on the ray's side
    glm::dvec3 view;    ///< back along the ray
    double eta;         ///< the index ahead over the index behind
    double offset;      ///< of secondary rays, along the normal
    double sharpness;   ///< FieldRay::pixel_slope of secondary rays
};
SurfacePoint surfacePoint(const ShadingSettings& settings, const TravellingRay& from, const SurfaceHit& hit);

/// Scattered (x), mirrored (y) and refracted (z) shares of the surface.
glm::dvec3 sharesOf(const SurfacePoint& point);

/// The share of the light from `towards` that leaves to the view, per steradian.
glm::dvec3 scatteredShare(const SurfacePoint& point, const glm::dvec3& towards);

/// A light as it arrives at a point.
struct LightArrival {
    glm::dvec3 towards{0.0};      ///< unit, to the light
    glm::dvec3 illuminance{0.0};  ///< on a surface that faces it
    double distance = 0.0;        ///< infinity: directional
};
LightArrival arrivalOf(const SurfaceLight& light, const glm::dvec3& p_world);

/// The rays that go on from a hit. Directions are unit.
TravellingRay rayFrom(const ShadingSettings& settings, const TravellingRay& from, const SurfaceHit& hit,
                      const SurfacePoint& point, const glm::dvec3& direction);
TravellingRay rayThrough(const ShadingSettings& settings, const TravellingRay& from, const SurfaceHit& hit,
                         const SurfacePoint& point, const glm::dvec3& direction);

/// What the lights make of the point: ambient light, and each light that reaches it.
glm::dvec3 litBy(const ShadingSettings& settings, const SurfaceTracer& tracer, const TravellingRay& from,
                 const SurfaceHit& hit, const SurfacePoint& point, RayCounts& counts);

}  // namespace edgewise::sdf
