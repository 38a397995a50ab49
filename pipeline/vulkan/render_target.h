// What a pass rasterizes on: an area of pixels, with a colour and a depth image or without.
#pragma once

#include "pipeline/vulkan/device.h"

namespace edgewise::vulkan {

/// eUndefined: there is no such image.
struct TargetFormat {
    vk::Format color = vk::Format::eUndefined;
    vk::Format depth = vk::Format::eUndefined;
    std::uint32_t samples = 1;

    bool hasColor() const { return color != vk::Format::eUndefined; }
    bool hasDepth() const { return depth != vk::Format::eUndefined; }
    vk::SampleCountFlagBits sampleBits() const { return static_cast<vk::SampleCountFlagBits>(samples); }
};

/// Clears its images before, and leaves the colour in the layout eShaderReadOnlyOptimal.
vk::raii::RenderPass makeRenderPass(const Device& device, const TargetFormat& format);

/// An image in device memory with a view of the whole.
class Image {
  public:
    Image(const Device& device, const std::string& name, vk::Format format, vk::Extent2D size,
          std::uint32_t samples, vk::ImageUsageFlags usage, vk::ImageAspectFlags aspect);
    vk::Image handle() const { return *image_; }
    vk::ImageView view() const { return **view_; }

  private:
    std::optional<vk::raii::DeviceMemory> memory_;  // outlives its image
    vk::raii::Image image_;
    std::optional<vk::raii::ImageView> view_;
};

/// Throws FailureError where the device has no room or no such area.
class RenderTarget {
  public:
    RenderTarget(const Device& device, const std::string& name, const TargetFormat& format,
                 std::uint32_t width, std::uint32_t height);

    const TargetFormat& format() const { return format_; }
    vk::Extent2D size() const { return size_; }
    vk::RenderPass renderPass() const { return *render_pass_; }
    vk::Framebuffer framebuffer() const { return **framebuffer_; }
    const Image& color() const { return *color_; }

  private:
    TargetFormat format_;
    vk::Extent2D size_;
    vk::raii::RenderPass render_pass_;
    std::optional<Image> color_, depth_;
    std::optional<vk::raii::Framebuffer> framebuffer_;
};

}  // namespace edgewise::vulkan
