#include "pipeline/vulkan/buffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pipeline/error.h"

namespace edgewise::vulkan {
namespace {

constexpr vk::BufferUsageFlags kUsage =
    vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferSrc |
    vk::BufferUsageFlagBits::eTransferDst | vk::BufferUsageFlagBits::eVertexBuffer |
    vk::BufferUsageFlagBits::eIndirectBuffer;

/// Local to the device if it can be, visible to the host always.
std::uint32_t memoryTypeFor(const Device& device, const vk::MemoryRequirements& needs) {
    using Bit = vk::MemoryPropertyFlagBits;
    const vk::MemoryPropertyFlags visible = Bit::eHostVisible | Bit::eHostCoherent;
    for (const vk::MemoryPropertyFlags wanted :
         {visible | Bit::eHostCached | Bit::eDeviceLocal, visible | Bit::eDeviceLocal,
          visible | Bit::eHostCached, visible})
        if (const auto type = device.memoryType(needs.memoryTypeBits, wanted)) return *type;
    throw FailureError("device vulkan", "it has no memory that the host can see");
}

}  // namespace

Buffer::Buffer(const Device& device, const std::string& name, std::size_t bytes)
    : bytes_(std::max<std::size_t>(bytes, 1)) {
    const auto fail = [&](const std::string& why) {
        throw FailureError("device vulkan", fmt::format("{} of {} MiB: {}", name, (bytes_ >> 20) + 1, why));
    };
    if (bytes_ > device.traits().max_storage_bytes)
        fail(fmt::format("{} binds {} MiB at most", device.traits().name,
                         device.traits().max_storage_bytes >> 20));
    try {
        buffer_.emplace(device.handle(), vk::BufferCreateInfo({}, bytes_, kUsage));
        const vk::MemoryRequirements needs = buffer_->getMemoryRequirements();
        memory_.emplace(device.handle(), vk::MemoryAllocateInfo(needs.size, memoryTypeFor(device, needs)));
        buffer_->bindMemory(**memory_, 0);
        mapped_ = memory_->mapMemory(0, VK_WHOLE_SIZE);
    } catch (const vk::SystemError& error) {
        fail(error.what());
    }
    device.name(*buffer_, name);
}

Buffer::Buffer(Buffer&& other) noexcept = default;
Buffer& Buffer::operator=(Buffer&& other) noexcept {
    buffer_.reset();  // before its memory
    bytes_ = other.bytes_, mapped_ = other.mapped_;
    memory_ = std::move(other.memory_);
    buffer_ = std::move(other.buffer_);
    return *this;
}
Buffer::~Buffer() = default;

}  // namespace edgewise::vulkan
