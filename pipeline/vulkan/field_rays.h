// Rays through a scene's field on the device: any rays, 64 neighbours a tile.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "pipeline/vulkan/compute_pass.h"
#include "pipeline/vulkan/field_shader.h"
#include "pipeline/vulkan/pass_graph.h"
#include "sdf/reals.h"
#include "sdf/sphere_trace.h"

namespace edgewise::vulkan {

/// EwRay of shaders/field/header.glsl: a FieldRay in float. t_max < t_min: nothing is traced.
struct GpuRay {
    float origin[3], direction[3];
    float t_min = 0.0f, t_max = -1.0f, pixel_radius = 0.0f, pixel_slope = 0.0f;
    float sign = 0.0f;  ///< of the field; 0: of its value where the ray begins
};

GpuRay gpuRay(const sdf::FieldRay& ray, double sign);

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

struct FieldCounts {
    std::uint64_t rays = 0, evaluations = 0, iterations = 0, failed_steps = 0;
    std::uint64_t cone_evaluations = 0, tiles = 0, empty_tiles = 0, dispatches = 0;
    std::uint64_t lists = 0, list_rows = 0, long_lists = 0;
    void add(const FieldCounts& more);
};

/// The answers of a batch of rays, by ray; views into buffers, until the next batch.
struct FieldAnswers {
    std::span<const GpuRayState> states;
    std::span<const GpuHit> hits;
};

class FieldRays {
  public:
    /// `turns`: of loops that a dispatch may take; 0: what the device can.
    FieldRays(const Device& device, const FieldShaders& shaders, const sdf::TraceSettings& settings,
              bool prune, std::uint32_t turns = 0);

    /// At most this many rays at once.
    static std::size_t most(const Device& device, const FieldShaders& shaders, std::size_t bytes);

    /// A multiple of 64 rays, tile by tile. `bounds`: a sphere that holds what is listed; lists are made for
    /// the depths within. Throws FailureError naming a point where the field is no number, or the line of a
    /// user's loop without end; Interrupted when `cancelled` says so. `with_hits`: else states alone count.
    FieldAnswers trace(std::span<const GpuRay> rays, const glm::dvec4& bounds,
                       const std::function<bool()>& cancelled = {}, bool with_hits = true);

    const FieldCounts& counts() const { return counts_; }
    const std::vector<PassTime>& times() const { return times_; }
    std::size_t bytes() const { return table_.bytes(); }

  private:
    struct Push {
        std::uint32_t count, first, steps, fresh, pruned;
    };
    void runPass(const std::string& name, ComputePass& pass, Push push, std::uint32_t invocations);
    void checkFlags() const;
    std::uint32_t activeRays() const;
    void traceCones(std::uint32_t tiles, const glm::dvec4& bounds, const std::function<bool()>& cancelled);
    void makeLists(std::uint32_t tiles);
    void finish(std::uint32_t count);
    void countLists(std::span<const std::uint32_t> items);  ///< of a tile
    void countAnswers(std::span<const GpuRayState> states);
    std::uint32_t evaluationsADispatch() const;

    const Device& device_;
    const FieldShaders& shaders_;
    sdf::TraceSettings settings_;
    bool prune_;
    std::uint32_t turns_;
    ComputePass trace_, finish_;
    std::unique_ptr<ComputePass> cones_, lists_;
    Buffer table_, flags_;
    std::unique_ptr<Buffer> rays_, states_, hits_, cone_table_, tiles_, items_;
    FieldCounts counts_;
    std::vector<PassTime> times_;
};

}  // namespace edgewise::vulkan
