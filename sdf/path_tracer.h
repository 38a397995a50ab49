// The light that a ray brings by path tracing (Kajiya 1986), with the surfaces of Shader.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "sdf/surface_light.h"

namespace edgewise::sdf {

/// Numbers for one path.
class PathSampler {
  public:
    virtual ~PathSampler() = default;
    /// Pair `index` of the path's coordinates, each in [0, 1): always the same for one path.
    virtual glm::dvec2 pair(std::uint32_t index) = 0;
};

struct PathSettings {
    int depth = 10;          ///< surfaces on a path that scatter, mirror or refract
    int roulette_after = 3;  ///< of them, before paths end by chance
    bool next_event = true;  ///< lights are looked for from each point that scatters; else only met
};

/// At each surface a path scatters (Lambert, or Blinn-Phong about the same directions), mirrors or refracts
/// by chance, as surfaceShares() says. Directional and point lights, which no path meets, are asked for at
/// each point that scatters; so are emissive analytic spheres, within the cone under which they are seen,
/// weighed against meeting them by chance (the power heuristic). Other emissive surfaces and the background
/// are met by chance alone. Ambient light is left out: paths bring it. Unlit surfaces end paths with their
/// colour.
class PathTracer {
  public:
    /// Refers to the tracer, which outlives it; `shapes` are the scene's analytic ones.
    PathTracer(ShadingSettings settings, const std::vector<AnalyticShape>& shapes,
               const SurfaceTracer& tracer, PathSettings path = {});

    /// Of one path. Colour, and alpha: whether the first ray meets a surface.
    glm::dvec4 radiance(const FieldRay& ray, PathSampler& sampler, RayCounts& counts,
                        double sign = 1.0) const;
    /// The same where the first ray's hit is known.
    glm::dvec4 radiance(const FieldRay& ray, const SurfaceHit& first, PathSampler& sampler, RayCounts& counts,
                        double sign = 1.0) const;

    /// Pairs that a path of that many surfaces takes.
    std::uint32_t pairs(int surfaces) const { return surfaces * pairs_; }

  private:
    struct Path;
    struct Lamp {
        std::uint32_t shape;
        glm::dvec3 center_world;
        double radius;
        glm::dvec3 radiance;
    };
    void step(Path& path, const SurfaceHit& hit, PathSampler& sampler, RayCounts& counts) const;
    glm::dvec3 met(const Path& path, const SurfaceHit& hit) const;
    void scatter(Path& path, const SurfaceHit& hit, const SurfacePoint& point, PathSampler& sampler,
                 RayCounts& counts) const;
    glm::dvec3 fromLights(const Path& path, const TravellingRay& out, const SurfacePoint& point,
                          RayCounts& counts) const;
    glm::dvec3 fromLamp(const Lamp& lamp, const Path& path, const TravellingRay& out,
                        const SurfacePoint& point, glm::dvec2 random, RayCounts& counts) const;

    ShadingSettings settings_;
    std::vector<Lamp> lamps_;
    const SurfaceTracer& tracer_;
    PathSettings path_;
    std::uint32_t pairs_;  ///< a surface: event and roulette, direction, each lamp
};

}  // namespace edgewise::sdf
