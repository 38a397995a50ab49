// Cones around rays through a scene's field on the device: the hit groups that each meets.
#pragma once

#include "pipeline/vulkan/field_tiles.h"
#include "sdf/cone_trace.h"

namespace edgewise::vulkan {

/// EwConeState of shaders/field/groups.glsl.
struct GpuConeState {
    float t, safe_t, last_t, value, slope, wall, entry_t, hard_t, least;
    std::uint32_t how;
    std::uint32_t evaluations;

    bool goesOn() const { return (how & 3u) == static_cast<std::uint32_t>(sdf::cones::kConeGoes); }
    bool negative() const { return (how & 16u) != 0; }  ///< the ray begins within the solid
    std::uint32_t groups() const { return how >> 8; }
};
/// EwGroup.
struct GpuGroup {
    std::uint32_t t_hard;
    float entry_t, least;
    sdf::ConeGroup group() const;
};

/// Pixel radii within which cones count.
double coneReach(const sdf::ConeSettings& settings);

class ConeRays {
  public:
    ConeRays(const Device& device, const FieldShaders& shaders, const sdf::ConeSettings& settings,
             FieldTiles& tiles);

    /// At most this many rays at once.
    static std::size_t most(const Device& device, const FieldShaders& shaders,
                            const sdf::ConeSettings& settings, std::size_t bytes);

    /// A multiple of 64 rays, tile by tile. Throws as FieldRays::trace.
    void begin(std::span<const GpuRay> rays, const glm::dvec4& bounds,
               const std::function<bool()>& cancelled);
    /// Until every cone has ended or has as many groups as there is room for: `room()` of them. False: all
    /// have ended. What a full one had is forgotten when it goes on.
    bool goOn(const std::function<bool()>& cancelled);

    double reach() const { return coneReach(settings_); }
    std::uint32_t room() const { return room_; }
    bool full(const GpuConeState& state) const { return state.goesOn() && state.groups() == room_; }
    /// By ray; views into buffers, until the next call.
    std::span<const GpuConeState> states() const { return buffers_.states->read<GpuConeState>(count_); }
    /// The first groups of all rays, then the second.
    std::span<const GpuGroup> groups() const { return buffers_.answers->read<GpuGroup>(count_ * room_); }

    const sdf::ConeSettings& settings() const { return settings_; }

  private:
    const Device& device_;
    sdf::ConeSettings settings_;
    FieldTiles& tiles_;
    ComputePass groups_;
    FieldBuffers buffers_;
    std::uint32_t count_ = 0, room_, fresh_ = 1;
};

}  // namespace edgewise::vulkan
