// The light that a ray brings: lights with hard shadows, and reflection and refraction by Whitted (1980).
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "sdf/surface_light.h"

namespace edgewise::sdf {

/// Surfaces scatter, mirror and refract by surfaceShares() of the shared text: glass by Fresnel's equations,
/// mirrors of which only the share at normal incidence is known by Schlick's. What is reflected wholly within
/// glass goes on as its refraction. What lies beyond the scene's bounces is black, as is what a ray brings
/// whose share has fallen below kLeastShare. Glass casts whole shadows.
class Shader {
  public:
    static constexpr double kLeastShare = 0x1p-12;

    /// Refers to the tracer, which outlives it.
    Shader(ShadingSettings settings, const SurfaceTracer& tracer);

    /// Colour, and alpha: 1 where the ray meets a surface, 0 with the background's colour where not.
    glm::dvec4 radiance(const FieldRay& ray, RayCounts& counts, double sign = 1.0) const;
    /// The same of a ray whose hit is known.
    glm::dvec4 shade(const FieldRay& ray, const SurfaceHit& hit, RayCounts& counts, double sign = 1.0) const;

    const ShadingSettings& settings() const { return settings_; }

    /// A ray, and which part of its light reaches the eye.
    struct Branch {
        TravellingRay way;
        glm::dvec3 share;
        int reflections, refractions;  ///< left
    };
    Branch first(const FieldRay& ray, double sign) const {
        return {{ray, sign}, glm::dvec3(1.0), settings_.reflections, settings_.refractions};
    }
    /// What the hit itself sends to the eye, `shadows` being asked whether lights reach it; the rays that go
    /// on, two at most, are added to `next`.
    glm::dvec3 follow(const Branch& branch, const SurfaceHit& hit, const SurfaceTracer& shadows,
                      std::vector<Branch>& next, RayCounts& counts) const;

  private:
    void reflect(Branch branch, const SurfaceHit& hit, const SurfacePoint& point, double share,
                 std::vector<Branch>& next, RayCounts& counts) const;
    void refract(Branch branch, const SurfaceHit& hit, const SurfacePoint& point, double share,
                 std::vector<Branch>& next, RayCounts& counts) const;

    ShadingSettings settings_;
    const SurfaceTracer& tracer_;
};

}  // namespace edgewise::sdf
