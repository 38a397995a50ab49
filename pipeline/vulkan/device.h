// An opened Vulkan device, without a window.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "pipeline/device_error.h"
#include "pipeline/vulkan/device_traits.h"

namespace edgewise::vulkan {

/// An opened device with one queue for graphics and compute. Every feature that `traits` names is on. With
/// EDGEWISE_VALIDATION=1 in the environment the validation layer watches; with EDGEWISE_COPY_READS=1 the host
/// reads buffers through copies, as it does those of a real GPU, on any device.
class Device {
  public:
    /// The first device that has all that is needed, real GPUs first. Throws DeviceError where none has.
    Device();
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceTraits& traits() const { return traits_; }
    const vk::raii::Device& handle() const { return *device_; }
    const vk::raii::Queue& queue() const { return *queue_; }
    const vk::raii::CommandPool& commandPool() const { return *command_pool_; }

    /// The index of a memory type among `allowed` with all of `wanted`; nullopt: there is none.
    std::optional<std::uint32_t> memoryType(std::uint32_t allowed, vk::MemoryPropertyFlags wanted) const;

    /// A name that validation messages and debuggers show.
    template <class Handle>
    void name(const Handle& object, const std::string& text) const {
        using Raw = typename std::remove_cvref_t<decltype(*object)>;
        setName(Raw::objectType, reinterpret_cast<std::uint64_t>(static_cast<typename Raw::CType>(*object)),
                text);
    }

    /// Submits and waits. Throws DeviceError for a lost device.
    void run(const vk::raii::CommandBuffer& commands) const;

    bool copiesReads() const { return copies_reads_; }

    bool validated() const { return validated_; }
    /// What the validation layer has said so far.
    const std::vector<std::string>& validationMessages() const { return messages_; }

  private:
    void setName(vk::ObjectType type, std::uint64_t handle, const std::string& text) const;

    DeviceTraits traits_;
    bool copies_reads_ = false, validated_ = false;
    std::vector<std::string> messages_;
    vk::raii::Context context_;
    std::optional<vk::raii::Instance> instance_;
    std::optional<vk::raii::DebugUtilsMessengerEXT> messenger_;
    std::optional<vk::raii::PhysicalDevice> physical_;
    vk::PhysicalDeviceMemoryProperties memory_;
    std::optional<vk::raii::Device> device_;
    std::optional<vk::raii::Queue> queue_;
    std::optional<vk::raii::CommandPool> command_pool_;
};

/// What Vulkan's own calls throw in `work` leaves it as a DeviceError.
template <class Work>
auto withDeviceErrors(Work&& work) {
    try {
        return work();
    } catch (const vk::SystemError& error) {
        throw DeviceError(error.what());
    }
}

}  // namespace edgewise::vulkan
