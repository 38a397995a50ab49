#include "pipeline/vulkan/compute_pass.h"

namespace edgewise::vulkan {
namespace {

constexpr vk::ShaderStageFlagBits kStage = vk::ShaderStageFlagBits::eCompute;

vk::raii::Pipeline makePipeline(const Device& device, const vk::raii::PipelineLayout& layout,
                                const ShaderCode& shader, const Specialization& constants) {
    const ShaderStage stage(device, kStage, shader, constants);
    return {device.handle(), nullptr, vk::ComputePipelineCreateInfo({}, stage.info(), *layout)};
}

}  // namespace

ComputePass::ComputePass(const Device& device, const ShaderCode& shader, BufferSlots slots,
                         std::size_t push_bytes, const Specialization& constants, std::size_t image_count)
    : bindings_(device, kStage, slots, image_count, push_bytes),
      pipeline_(makePipeline(device, bindings_.layout(), shader, constants)) {
    device.name(pipeline_, std::string(shader.name));
    if (image_count == 0) warmUp(device, slots.count, push_bytes);
}

/// A driver may leave the compiling to the first dispatch: this one has nothing to do (every shader looks at
/// the counts of its push constants first), so that no later one is timed with it.
void ComputePass::warmUp(const Device& device, std::size_t buffer_count, std::size_t push_bytes) {
    const Buffer none = bufferOf(device, "warm-up", std::vector<std::uint32_t>(4096, 0));
    const std::vector<std::byte> zeros(push_bytes, std::byte{0});
    PushBytes push;
    push.data = zeros.data(), push.size = push_bytes;
    const vk::raii::CommandBuffers lists(device.handle(),
                                         {*device.commandPool(), vk::CommandBufferLevel::ePrimary, 1});
    const vk::raii::CommandBuffer& commands = lists.front();
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    record(commands, std::vector<Range>(buffer_count, Range(none)), {}, push, {1});
    commands.end();
    device.run(commands);
    forgetSets();
}

void ComputePass::record(const vk::raii::CommandBuffer& commands, const std::vector<Range>& buffers,
                         const std::vector<vk::ImageView>& images, const PushBytes& push, Groups groups) {
    if (groups.x == 0 || groups.y == 0) return;
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    bindings_.bind(commands, vk::PipelineBindPoint::eCompute, buffers, images, push);
    commands.dispatch(groups.x, groups.y, 1);
}

}  // namespace edgewise::vulkan
