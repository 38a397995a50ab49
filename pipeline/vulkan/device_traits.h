// Which Vulkan devices there are, and what they can.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace edgewise::vulkan {

/// What decides whether and how the pipeline runs on a device.
struct DeviceTraits {
    std::string name;
    bool real_gpu = false;  ///< not a program on the CPU
    bool fp64 = false, int64 = false, int64_atomics = false;
    bool geometry_shader = false, conservative_rasterization = false;
    bool fragment_stores = false;         ///< fragment shaders write to buffers
    std::uint32_t max_target_px = 0;      ///< a side of what passes rasterize on
    std::uint32_t max_stage_buffers = 0;  ///< storage buffers that one shader may bind
    std::size_t max_storage_bytes = 0;    ///< of one storage buffer's binding
    std::size_t max_uniform_bytes = 0;    ///< of one uniform buffer's binding
    std::size_t max_shared_bytes = 0;     ///< of a workgroup
    std::size_t max_heap_bytes = 0;       ///< of the largest device-local heap
    /// Turns that the loops of the invocations which run together may take in all: lavapipe stops them then,
    /// without a word.
    std::uint32_t loop_turns = 0xffffffff;
    std::uint32_t standard_samples = 0;  ///< bit N: colour and depth have N samples at standard locations
    std::uint32_t subpixel_bits = 0;     ///< of rasterized corners
    double tick_ns = 0.0;                ///< of a timestamp; 0: the queue has none
};

/// Storage buffers that the pipeline's hungriest stage, visibility, binds.
inline constexpr std::uint32_t kMostBindings = 23;

/// All devices of this machine, real GPUs first; empty where there is no Vulkan.
std::vector<DeviceTraits> listDevices();

/// Why the pipeline cannot run on such a device, in words; nullopt: it can.
std::optional<std::string> whatIsMissing(const DeviceTraits& traits);

}  // namespace edgewise::vulkan
