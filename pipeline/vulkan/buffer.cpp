#include "pipeline/vulkan/buffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pipeline/device_error.h"

namespace edgewise::vulkan {
namespace {

constexpr vk::BufferUsageFlags kUsage =
    vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eUniformBuffer |
    vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst |
    vk::BufferUsageFlagBits::eVertexBuffer | vk::BufferUsageFlagBits::eIndirectBuffer;

struct MemoryType {
    std::uint32_t index;
    bool cached;
};

using MemoryBit = vk::MemoryPropertyFlagBits;

MemoryType memoryTypeFor(const Device& device, const vk::MemoryRequirements& needs,
                         std::initializer_list<vk::MemoryPropertyFlags> preferred) {
    for (const vk::MemoryPropertyFlags extra : preferred) {
        const vk::MemoryPropertyFlags wanted = MemoryBit::eHostVisible | MemoryBit::eHostCoherent | extra;
        if (const auto type = device.memoryType(needs.memoryTypeBits, wanted))
            return {*type, static_cast<bool>(extra & MemoryBit::eHostCached)};
    }
    throw DeviceError("it has no memory that the host can see");
}

}  // namespace

Buffer::Buffer(const Device& device, const std::string& name, std::size_t bytes)
    : Buffer(device, name, bytes, Place::kDevice) {}

Buffer::Buffer(const Device& device, const std::string& name, std::size_t bytes, Place place)
    : device_(&device), bytes_(std::max<std::size_t>(bytes, 1)) {
    const auto fail = [&](const std::string& why) {
        throw DeviceError(fmt::format("{} of {} MiB: {}", name, (bytes_ >> 20) + 1, why));
    };
    if (bytes_ > device.traits().max_storage_bytes)
        fail(fmt::format("{} binds {} MiB at most", device.traits().name,
                         device.traits().max_storage_bytes >> 20));
    try {
        buffer_.emplace(device.handle(), vk::BufferCreateInfo({}, bytes_, kUsage));
        const vk::MemoryRequirements needs = buffer_->getMemoryRequirements();
        const MemoryType type = place == Place::kHost
                                    ? memoryTypeFor(device, needs, {MemoryBit::eHostCached, {}})
                                    : memoryTypeFor(device, needs,
                                                    {MemoryBit::eHostCached | MemoryBit::eDeviceLocal,
                                                     MemoryBit::eDeviceLocal,
                                                     MemoryBit::eHostCached,
                                                     {}});
        cached_ = place == Place::kHost || (type.cached && !device.copiesReads());
        memory_.emplace(device.handle(), vk::MemoryAllocateInfo(needs.size, type.index));
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
    copy_ = std::move(other.copy_);
    device_ = other.device_, cached_ = other.cached_;
    bytes_ = other.bytes_, mapped_ = other.mapped_;
    memory_ = std::move(other.memory_);
    buffer_ = std::move(other.buffer_);
    return *this;
}
Buffer::~Buffer() = default;

const void* Buffer::fetch(std::size_t offset, std::size_t bytes) const {
    if (cached_ || bytes == 0) return static_cast<const std::byte*>(mapped_) + offset;
    if (!copy_ || copy_->bytes() < bytes)
        copy_.reset(new Buffer(*device_, "copy for the host", bytes, Place::kHost));
    const vk::raii::CommandBuffers lists(device_->handle(),
                                         {*device_->commandPool(), vk::CommandBufferLevel::ePrimary, 1});
    const vk::raii::CommandBuffer& commands = lists.front();
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    commands.copyBuffer(handle(), copy_->handle(), vk::BufferCopy(offset, 0, bytes));
    const vk::MemoryBarrier copied(vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eHostRead);
    commands.pipelineBarrier(vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost, {},
                             copied, {}, {});
    commands.end();
    device_->run(commands);
    return copy_->mapped_;
}

}  // namespace edgewise::vulkan
