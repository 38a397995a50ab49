// Tiles of 64 rays through a scene's field on the device: how far each tile is free, and what counts along
// it.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "pipeline/vulkan/compute_pass.h"
#include "pipeline/vulkan/field_shader.h"
#include "pipeline/vulkan/pass_graph.h"
#include "sdf/sphere_trace.h"

namespace edgewise::vulkan {

inline constexpr std::uint32_t kTileRays = 64;

/// EwRay of shaders/field/header.glsl: a FieldRay in float. t_max < t_min: nothing is traced.
struct GpuRay {
    float origin[3], direction[3];
    float t_min = 0.0f, t_max = -1.0f, pixel_radius = 0.0f, pixel_slope = 0.0f;
    float sign = 0.0f;  ///< of the field; 0: of its value where the ray begins
};

GpuRay gpuRay(const sdf::FieldRay& ray, double sign);

struct FieldCounts {
    std::uint64_t rays = 0, evaluations = 0, iterations = 0, failed_steps = 0;
    std::uint64_t cone_evaluations = 0, tiles = 0, empty_tiles = 0, dispatches = 0;
    std::uint64_t lists = 0, list_rows = 0, long_lists = 0;
    void add(const FieldCounts& more);
};

/// What the shaders of shaders/field/ bind. It grows to the largest batch of rays.
struct FieldBuffers {
    std::unique_ptr<Buffer> rays, states, answers, cones, tiles, items;
};

/// A buffer of at least so many bytes: the one there is, or a new one.
void grow(const Device& device, std::unique_ptr<Buffer>& buffer, const char* name, std::size_t bytes);

class FieldTiles {
  public:
    struct Push {
        std::uint32_t count, first, steps, fresh, pruned;
    };
    static constexpr std::size_t kBuffers = 8;

    /// `turns`: of loops that a dispatch may take; 0: what the device can.
    FieldTiles(const Device& device, const FieldShaders& shaders, bool prepass, bool prune,
               std::uint32_t turns = 0);

    ComputePass pass(const char* name, const std::vector<std::uint32_t>& code) const;
    /// Rays at once whose buffers, with so many bytes of states and answers a ray, have no more than `bytes`.
    static std::size_t most(const Device& device, const FieldShaders& shaders, std::size_t bytes,
                            std::size_t state_bytes, std::size_t answer_bytes);

    /// A multiple of 64 rays, tile by tile, of which all within `reach` pixel radii counts. `bounds`: a
    /// sphere that holds what is listed; lists are made for the depths within.
    void begin(FieldBuffers& buffers, std::span<const GpuRay> rays, double reach, const glm::dvec4& bounds,
               const std::function<bool()>& cancelled);
    /// The rays alone, for passes that ask no more of tiles.
    void place(FieldBuffers& buffers, std::span<const GpuRay> rays);
    /// Throws FailureError naming a point where the field is no number, or the line of a user's loop without
    /// end.
    void run(const char* name, ComputePass& pass, const FieldBuffers& buffers, Push push,
             std::uint32_t invocations);
    /// Whom the last run left without an end; who has no room for more answers.
    std::uint32_t activeRays() const { return flags_.read<std::uint32_t>(8)[5]; }
    std::uint32_t pausedRays() const { return flags_.read<std::uint32_t>(8)[6]; }
    std::uint32_t evaluationsADispatch() const;
    bool prunes() const { return lists_ != nullptr; }

    FieldCounts& counts() { return counts_; }
    const FieldCounts& counts() const { return counts_; }
    const std::vector<PassTime>& times() const { return times_; }
    std::size_t tableBytes() const { return table_.bytes(); }

  private:
    void book(const char* name, double seconds);
    void checkFlags() const;
    void march(FieldBuffers& buffers, std::uint32_t tiles, const glm::dvec4& bounds,
               const std::function<bool()>& cancelled);
    void makeLists(FieldBuffers& buffers, std::uint32_t tiles);
    void countLists(std::span<const std::uint32_t> items);  ///< of a tile

    const Device& device_;
    const FieldShaders& shaders_;
    std::uint32_t turns_;
    Buffer table_, flags_;
    std::unique_ptr<ComputePass> cones_, lists_;
    FieldCounts counts_;
    std::vector<PassTime> times_;
};

}  // namespace edgewise::vulkan
