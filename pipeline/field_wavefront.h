// Light along many rays at once, for devices that trace rays in batches.
#pragma once

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
    virtual std::vector<char> occluded(std::span<const sdf::TravellingRay> rays) = 0;
};

/// What sdf::Shader makes of rays whose hits are known, a generation at a time: shadow rays of all its hits,
/// then the rays that go on from them, in the order of the rays that they go on from. A ray's colour depends
/// on no other ray, and not on threads.
std::vector<glm::dvec4> shadeWavefront(const sdf::Shader& shader, RayBatches& batches,
                                       std::span<const sdf::TravellingRay> rays,
                                       std::vector<sdf::SurfaceHit> hits, sdf::RayCounts& counts);

}  // namespace edgewise
