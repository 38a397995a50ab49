// Device memory as move-only values.
#pragma once

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "pipeline/vulkan/device.h"

namespace edgewise::vulkan {

/// A storage buffer that the host sees mapped, in device memory where the device offers both. Contents are
/// undefined at first.
class Buffer {
  public:
    /// At least 1 byte is allocated. Throws FailureError where the device has no room, or where no binding
    /// may be as large.
    Buffer(const Device& device, const std::string& name, std::size_t bytes);
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;
    ~Buffer();

    std::size_t bytes() const { return bytes_; }
    vk::Buffer handle() const { return **buffer_; }

    /// The first `count` items, from byte `offset` on; valid while no command that uses the buffer runs.
    template <class T>
    std::span<T> view(std::size_t count, std::size_t offset = 0) const {
        return {reinterpret_cast<T*>(static_cast<std::byte*>(mapped_) + offset), count};
    }
    template <class T>
    std::span<T> all() const {
        return view<T>(bytes_ / sizeof(T));
    }

  private:
    std::size_t bytes_ = 0;
    std::optional<vk::raii::DeviceMemory> memory_;  // outlives its buffer
    std::optional<vk::raii::Buffer> buffer_;
    void* mapped_ = nullptr;
};

/// A buffer of these items.
template <class T>
Buffer bufferOf(const Device& device, const std::string& name, std::span<const T> items) {
    static_assert(std::is_trivially_copyable_v<T>);
    Buffer buffer(device, name, items.size_bytes());
    if (!items.empty()) std::memcpy(buffer.view<T>(items.size()).data(), items.data(), items.size_bytes());
    return buffer;
}
template <class T>
Buffer bufferOf(const Device& device, const std::string& name, const std::vector<T>& items) {
    return bufferOf(device, name, std::span<const T>(items));
}

}  // namespace edgewise::vulkan
