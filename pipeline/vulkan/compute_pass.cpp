#include "pipeline/vulkan/compute_pass.h"

#include <cassert>

#include "pipeline/vulkan/exact_spirv.h"
#include "pipeline/vulkan/shader.h"

namespace edgewise::vulkan {
namespace {

vk::raii::DescriptorSetLayout makeSetLayout(const Device& device, std::size_t count) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (std::uint32_t i = 0; i < count; ++i)
        bindings.emplace_back(i, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute);
    return {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::PipelineLayout makeLayout(const Device& device, const vk::raii::DescriptorSetLayout& sets,
                                    std::size_t push) {
    const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, static_cast<std::uint32_t>(push));
    return {device.handle(), vk::PipelineLayoutCreateInfo({}, 1, &*sets, push > 0 ? 1 : 0, &range)};
}

vk::raii::Pipeline makePipeline(const Device& device, const vk::raii::PipelineLayout& layout,
                                std::string_view shader, const Specialization& constants) {
    const std::vector<std::uint32_t> words = withExactArithmetic(spirv(shader));
    const vk::raii::ShaderModule module(device.handle(), vk::ShaderModuleCreateInfo({}, words));
    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i) entries.emplace_back(i, 4 * i, 4);
    const vk::SpecializationInfo special(static_cast<std::uint32_t>(entries.size()), entries.data(),
                                         4 * constants.size(), constants.data());
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                  &special);
    return {device.handle(), nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout)};
}

}  // namespace

ComputePass::ComputePass(const Device& device, std::string_view shader, std::size_t buffer_count,
                         std::size_t push_bytes, const Specialization& constants)
    : device_(&device),
      buffer_count_(buffer_count),
      push_bytes_(push_bytes),
      set_layout_(makeSetLayout(device, buffer_count)),
      layout_(makeLayout(device, set_layout_, push_bytes)),
      pipeline_(makePipeline(device, layout_, shader, constants)) {
    device.name(pipeline_, std::string(shader));
}

vk::DescriptorSet ComputePass::makeSet(const std::vector<Range>& buffers) {
    assert(buffers.size() == buffer_count_);
    const vk::DescriptorPoolSize size(vk::DescriptorType::eStorageBuffer,
                                      static_cast<std::uint32_t>(buffer_count_));
    pools_.emplace_back(device_->handle(), vk::DescriptorPoolCreateInfo({}, 1, size));
    const vk::DescriptorSetAllocateInfo info(*pools_.back(), *set_layout_);
    const vk::DescriptorSet set =
        (*device_->handle()).allocateDescriptorSets(info, *device_->handle().getDispatcher())[0];
    std::vector<vk::DescriptorBufferInfo> infos;
    for (const Range& range : buffers) infos.emplace_back(range.buffer, range.offset, range.bytes);
    std::vector<vk::WriteDescriptorSet> writes;
    for (std::uint32_t i = 0; i < infos.size(); ++i)
        writes.emplace_back(set, i, 0, 1, vk::DescriptorType::eStorageBuffer, nullptr, &infos[i]);
    device_->handle().updateDescriptorSets(writes, {});
    return set;
}

void ComputePass::record(const vk::raii::CommandBuffer& commands, const std::vector<Range>& buffers,
                         const void* push, std::size_t push_bytes, Groups groups) {
    assert(push_bytes == push_bytes_);
    if (groups.x == 0 || groups.y == 0) return;
    sets_.push_back(makeSet(buffers));
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, sets_.back(), {});
    if (push_bytes > 0)
        commands.pushConstants<std::byte>(
            *layout_, vk::ShaderStageFlagBits::eCompute, 0,
            vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push_bytes),
                                            static_cast<const std::byte*>(push)));
    commands.dispatch(groups.x, groups.y, 1);
}

}  // namespace edgewise::vulkan
