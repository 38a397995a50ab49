// Device memory as move-only values.
#pragma once

#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "pipeline/vulkan/device.h"

namespace edgewise::vulkan {

/// A storage buffer that the host writes mapped, in device memory where the device offers both. Contents are
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

    /// For writing: `count` items from byte `offset` on; valid while no command that uses the buffer runs.
    template <class T>
    std::span<T> view(std::size_t count, std::size_t offset = 0) const {
        return {reinterpret_cast<T*>(static_cast<std::byte*>(mapped_) + offset), count};
    }

    /// For reading, likewise, until the next call: the host reads memory of a real GPU through its bus a word
    /// at a time, so that there it is a copy that the device makes.
    template <class T>
    std::span<const T> read(std::size_t count, std::size_t offset = 0) const {
        return {static_cast<const T*>(fetch(offset, count * sizeof(T))), count};
    }

  private:
    const void* fetch(std::size_t offset, std::size_t bytes) const;

    const Device* device_ = nullptr;
    std::size_t bytes_ = 0;
    std::optional<vk::raii::DeviceMemory> memory_;  // outlives its buffer
    std::optional<vk::raii::Buffer> buffer_;
    void* mapped_ = nullptr;
    bool cached_ = false;                   ///< the host reads it as fast as its own memory
    mutable std::unique_ptr<Buffer> copy_;  ///< in the host's memory
    enum class Place { kDevice, kHost };
    Buffer(const Device& device, const std::string& name, std::size_t bytes, Place place);
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
