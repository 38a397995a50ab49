// Rays through a scene's field on the device: any rays, 64 neighbours a tile.
#pragma once

#include "pipeline/vulkan/field_tiles.h"
#include "sdf/reals.h"

namespace edgewise::vulkan {

enum class FieldEnd : std::uint32_t { kRunning, kSurface, kCandidate, kFar, kOutOfSteps, kEmpty };

namespace tracing {
using real = float;
using sdf::max, sdf::min;
#include "shaders/shared/sdf_trace_step.glsl"
}  // namespace tracing

struct GpuRayState {
    tracing::TraceState at;
    float sign;
    std::uint32_t evaluations, iterations;
    FieldEnd end;
    bool hit() const { return end == FieldEnd::kSurface || end == FieldEnd::kCandidate; }
};

/// Of rays that hit; others are undefined. `value` is over L, times the ray's sign. `normal`, times the
/// sign, and `color`: of maps, that albedo() gives.
struct GpuHit {
    float t, value, normal[3], color[3];
};

/// The answers of a batch of rays, by ray; views into buffers, until the next batch.
struct FieldAnswers {
    std::span<const GpuRayState> states;
    std::span<const GpuHit> hits;
};

class FieldRays {
  public:
    FieldRays(const Device& device, const FieldShaders& shaders, const sdf::TraceSettings& settings,
              FieldTiles& tiles);

    /// At most this many rays at once.
    static std::size_t most(const Device& device, const FieldShaders& shaders, std::size_t bytes);

    /// A multiple of 64 rays, tile by tile. `bounds`: a sphere that holds what is listed; lists are made for
    /// the depths within. Throws what FieldTiles::run throws; Interrupted when `cancelled` says so.
    /// `with_hits`: else states alone count.
    FieldAnswers trace(std::span<const GpuRay> rays, const glm::dvec4& bounds,
                       const std::function<bool()>& cancelled = {}, bool with_hits = true);
    /// A map's slope and colour at a depth of each ray: a multiple of 64. Views, until the next batch.
    std::span<const GpuHit> describe(std::span<const GpuRay> rays, std::span<const float> t);

    const FieldCounts& counts() const { return tiles_.counts(); }

  private:
    void finish(std::uint32_t count, std::uint32_t first_turn);
    void countAnswers(std::span<const GpuRayState> states);

    const Device& device_;
    const FieldShaders& shaders_;
    sdf::TraceSettings settings_;
    FieldTiles& tiles_;
    ComputePass trace_, finish_;
    FieldBuffers buffers_;
};

}  // namespace edgewise::vulkan
