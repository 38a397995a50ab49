#include "pipeline/vulkan/compute_pass.h"

namespace edgewise::vulkan {
namespace {

constexpr vk::ShaderStageFlagBits kStage = vk::ShaderStageFlagBits::eCompute;

vk::raii::Pipeline makePipeline(const Device& device, const vk::raii::PipelineLayout& layout,
                                std::string_view shader, const Specialization& constants) {
    const ShaderStage stage(device, kStage, shader, constants);
    return {device.handle(), nullptr, vk::ComputePipelineCreateInfo({}, stage.info(), *layout)};
}

}  // namespace

ComputePass::ComputePass(const Device& device, std::string_view shader, std::size_t buffer_count,
                         std::size_t push_bytes, const Specialization& constants, std::size_t image_count)
    : bindings_(device, kStage, buffer_count, image_count, push_bytes),
      pipeline_(makePipeline(device, bindings_.layout(), shader, constants)) {
    device.name(pipeline_, std::string(shader));
}

void ComputePass::record(const vk::raii::CommandBuffer& commands, const std::vector<Range>& buffers,
                         const std::vector<vk::ImageView>& images, const PushBytes& push, Groups groups) {
    if (groups.x == 0 || groups.y == 0) return;
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    bindings_.bind(commands, vk::PipelineBindPoint::eCompute, buffers, images, push);
    commands.dispatch(groups.x, groups.y, 1);
}

}  // namespace edgewise::vulkan
