// Light along many rays at once, for devices that trace rays in batches.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "sdf/shader.h"

namespace edgewise {

/// sdf::SurfaceTracer's questions, of many rays.
class RayBatches {
  public:
    virtual ~RayBatches() = default;
    /// One entry a ray.
    virtual std::vector<sdf::SurfaceHit> nearest(std::span<const sdf::TravellingRay> rays) = 0;
    /// Where each meets the scene, and no more; infinite where it meets nothing.
    virtual std::vector<double> depths(std::span<const sdf::TravellingRay> rays) = 0;
    /// The hits of rays whose depths are known; infinite ones are misses.
    virtual std::vector<sdf::SurfaceHit> describe(std::span<const sdf::TravellingRay> rays,
                                                  std::span<const double> depths) = 0;
    virtual std::vector<char> occluded(std::span<const sdf::TravellingRay> rays) = 0;
};

/// What sdf::Shader makes of rays whose hits are known, a generation at a time: shadow rays of all its hits,
/// then the rays that go on from them, in the order of the rays that they go on from. A ray's colour depends
/// on no other ray, and not on threads. `sights`, if any: two colours whose rays see the same of everything,
/// lights and materials in the same order, have the same number here; one a ray.
std::vector<glm::dvec4> shadeWavefront(const sdf::Shader& shader, RayBatches& batches,
                                       std::span<const sdf::TravellingRay> rays,
                                       std::span<const sdf::SurfaceHit> hits, sdf::RayCounts& counts,
                                       std::vector<std::uint32_t>* sights = nullptr);

/// A sight with one answer more.
inline std::uint32_t sightWith(std::uint32_t sight, std::uint32_t answer) {
    return (sight ^ answer) * 0x9e3779b1u + 0x85ebca6bu;
}

}  // namespace edgewise
