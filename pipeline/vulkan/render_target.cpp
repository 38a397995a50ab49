#include "pipeline/vulkan/render_target.h"

#include <fmt/format.h>

#include <array>

#include "pipeline/device_error.h"

namespace edgewise::vulkan {
namespace {

vk::AttachmentDescription attachment(const TargetFormat& target, vk::Format format, vk::ImageLayout last) {
    const bool kept = last == vk::ImageLayout::eShaderReadOnlyOptimal;
    return {{},
            format,
            target.sampleBits(),
            vk::AttachmentLoadOp::eClear,
            kept ? vk::AttachmentStoreOp::eStore : vk::AttachmentStoreOp::eDontCare,
            vk::AttachmentLoadOp::eDontCare,
            vk::AttachmentStoreOp::eDontCare,
            vk::ImageLayout::eUndefined,
            last};
}

/// All that came before is done before the images change, and they are written before all that follows.
std::array<vk::SubpassDependency, 2> orderedWithTheRest() {
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const vk::PipelineStageFlags own = Stage::eColorAttachmentOutput | Stage::eEarlyFragmentTests |
                                       Stage::eLateFragmentTests | Stage::eFragmentShader;
    const vk::AccessFlags writes = Access::eColorAttachmentWrite | Access::eDepthStencilAttachmentWrite;
    const vk::AccessFlags all = writes | Access::eColorAttachmentRead | Access::eDepthStencilAttachmentRead;
    return {
        vk::SubpassDependency(VK_SUBPASS_EXTERNAL, 0, Stage::eAllCommands, own, Access::eMemoryWrite, all),
        vk::SubpassDependency(0, VK_SUBPASS_EXTERNAL, own, Stage::eAllCommands, writes,
                              Access::eMemoryRead | Access::eMemoryWrite)};
}

vk::Extent2D checkedSize(const Device& device, const std::string& name, std::uint32_t width,
                         std::uint32_t height) {
    const std::uint32_t most = device.traits().max_target_px;
    if (width > most || height > most)
        throw DeviceError(fmt::format("{} is {} x {} pixels; {} has {} a side at most", name, width, height,
                                      device.traits().name, most));
    return {width, height};
}

}  // namespace

vk::raii::RenderPass makeRenderPass(const Device& device, const TargetFormat& format) {
    using Layout = vk::ImageLayout;
    std::vector<vk::AttachmentDescription> attachments;
    vk::AttachmentReference color, depth;
    if (format.hasColor()) {
        color = {static_cast<std::uint32_t>(attachments.size()), Layout::eColorAttachmentOptimal};
        attachments.push_back(attachment(format, format.color, Layout::eShaderReadOnlyOptimal));
    }
    if (format.hasDepth()) {
        depth = {static_cast<std::uint32_t>(attachments.size()), Layout::eDepthStencilAttachmentOptimal};
        attachments.push_back(attachment(format, format.depth, Layout::eDepthStencilAttachmentOptimal));
    }
    vk::SubpassDescription subpass;
    subpass.pipelineBindPoint = vk::PipelineBindPoint::eGraphics;
    if (format.hasColor()) subpass.setColorAttachments(color);
    if (format.hasDepth()) subpass.setPDepthStencilAttachment(&depth);
    const auto dependencies = orderedWithTheRest();
    return {device.handle(), vk::RenderPassCreateInfo({}, attachments, subpass, dependencies)};
}

Image::Image(const Device& device, const std::string& name, vk::Format format, vk::Extent2D size,
             std::uint32_t samples, vk::ImageUsageFlags usage, vk::ImageAspectFlags aspect)
    : image_(device.handle(), vk::ImageCreateInfo({}, vk::ImageType::e2D, format, vk::Extent3D(size, 1), 1, 1,
                                                  static_cast<vk::SampleCountFlagBits>(samples),
                                                  vk::ImageTiling::eOptimal, usage)) {
    const vk::MemoryRequirements needs = image_.getMemoryRequirements();
    const auto type = device.memoryType(needs.memoryTypeBits, vk::MemoryPropertyFlagBits::eDeviceLocal);
    if (!type) throw DeviceError("it has no memory for images");
    try {
        memory_.emplace(device.handle(), vk::MemoryAllocateInfo(needs.size, *type));
    } catch (const vk::SystemError& error) {
        throw DeviceError(fmt::format("{} of {} MiB: {}", name, (needs.size >> 20) + 1, error.what()));
    }
    image_.bindMemory(**memory_, 0);
    const vk::ImageSubresourceRange whole(aspect, 0, 1, 0, 1);
    view_.emplace(device.handle(),
                  vk::ImageViewCreateInfo({}, *image_, vk::ImageViewType::e2D, format, {}, whole));
    device.name(image_, name);
}

RenderTarget::RenderTarget(const Device& device, const std::string& name, const TargetFormat& format,
                           std::uint32_t width, std::uint32_t height)
    : format_(format),
      size_(checkedSize(device, name, width, height)),
      render_pass_(makeRenderPass(device, format)) {
    using Usage = vk::ImageUsageFlagBits;
    std::vector<vk::ImageView> views;
    if (format.hasColor()) {
        color_.emplace(device, name + " colour", format.color, size_, format.samples,
                       Usage::eColorAttachment | Usage::eSampled, vk::ImageAspectFlagBits::eColor);
        views.push_back(color_->view());
    }
    if (format.hasDepth()) {
        depth_.emplace(device, name + " depth", format.depth, size_, format.samples,
                       Usage::eDepthStencilAttachment, vk::ImageAspectFlagBits::eDepth);
        views.push_back(depth_->view());
    }
    framebuffer_.emplace(device.handle(),
                         vk::FramebufferCreateInfo({}, *render_pass_, views, width, height, 1));
    device.name(*framebuffer_, name);
}

}  // namespace edgewise::vulkan
