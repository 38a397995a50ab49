#include "pipeline/vulkan/bindings.h"

#include <cassert>

#include "pipeline/vulkan/exact_spirv.h"
#include "pipeline/vulkan/shader.h"

namespace edgewise::vulkan {
namespace {

vk::raii::DescriptorSetLayout makeSetLayout(const Device& device, vk::ShaderStageFlags stages,
                                            const BufferSlots& slots, std::size_t images) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (std::uint32_t i = 0; i < slots.count + images; ++i)
        bindings.emplace_back(i, i < slots.count ? slots.typeOf(i) : vk::DescriptorType::eSampledImage, 1,
                              stages);
    return {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::PipelineLayout makeLayout(const Device& device, vk::ShaderStageFlags stages,
                                    const vk::raii::DescriptorSetLayout& sets, std::size_t push) {
    const vk::PushConstantRange range(stages, 0, static_cast<std::uint32_t>(push));
    return {device.handle(), vk::PipelineLayoutCreateInfo({}, 1, &*sets, push > 0 ? 1 : 0, &range)};
}

vk::raii::ShaderModule makeModule(const Device& device, const ShaderCode& shader) {
    const std::vector<std::uint32_t> words = withExactArithmetic(shader.words);
    return {device.handle(), vk::ShaderModuleCreateInfo({}, words)};
}

}  // namespace

Bindings::Bindings(const Device& device, vk::ShaderStageFlags stages, BufferSlots slots,
                   std::size_t image_count, std::size_t push_bytes)
    : device_(&device),
      stages_(stages),
      slots_(slots),
      image_count_(image_count),
      push_bytes_(push_bytes),
      set_layout_(makeSetLayout(device, stages, slots, image_count)),
      layout_(makeLayout(device, stages, set_layout_, push_bytes)) {}

vk::DescriptorSet Bindings::makeSet(const std::vector<BufferRange>& buffers,
                                    const std::vector<vk::ImageView>& images) {
    std::vector<vk::DescriptorPoolSize> sizes;
    const std::size_t uniforms = slots_.uniform ? 1 : 0;
    if (slots_.count > uniforms)
        sizes.emplace_back(vk::DescriptorType::eStorageBuffer,
                           static_cast<std::uint32_t>(slots_.count - uniforms));
    if (uniforms > 0) sizes.emplace_back(vk::DescriptorType::eUniformBuffer, 1);
    if (image_count_ > 0)
        sizes.emplace_back(vk::DescriptorType::eSampledImage, static_cast<std::uint32_t>(image_count_));
    pools_.emplace_back(device_->handle(), vk::DescriptorPoolCreateInfo({}, 1, sizes));
    const vk::DescriptorSetAllocateInfo info(*pools_.back(), *set_layout_);
    const vk::DescriptorSet set =
        (*device_->handle()).allocateDescriptorSets(info, *device_->handle().getDispatcher())[0];
    std::vector<vk::DescriptorBufferInfo> ranges;
    for (const BufferRange& range : buffers) ranges.emplace_back(range.buffer, range.offset, range.bytes);
    std::vector<vk::DescriptorImageInfo> views;
    for (const vk::ImageView& view : images)
        views.emplace_back(vk::Sampler(), view, vk::ImageLayout::eShaderReadOnlyOptimal);
    std::vector<vk::WriteDescriptorSet> writes;
    std::uint32_t binding = 0;
    for (const auto& range : ranges)
        writes.emplace_back(set, binding, 0, 1, slots_.typeOf(binding), nullptr, &range), ++binding;
    for (const auto& view : views)
        writes.emplace_back(set, binding++, 0, 1, vk::DescriptorType::eSampledImage, &view);
    device_->handle().updateDescriptorSets(writes, {});
    return set;
}

void Bindings::bind(const vk::raii::CommandBuffer& commands, vk::PipelineBindPoint point,
                    const std::vector<BufferRange>& buffers, const std::vector<vk::ImageView>& images,
                    const PushBytes& push) {
    assert(buffers.size() == slots_.count && images.size() == image_count_ && push.size == push_bytes_);
    if (slots_.count + image_count_ > 0) {
        sets_.push_back(makeSet(buffers, images));
        commands.bindDescriptorSets(point, *layout_, 0, sets_.back(), {});
    }
    if (push.size > 0)
        commands.pushConstants<std::byte>(
            *layout_, stages_, 0,
            vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push.size),
                                            static_cast<const std::byte*>(push.data)));
}

ShaderCode::ShaderCode(std::string_view embedded) : name(embedded), words(spirv(embedded)) {}

ShaderStage::ShaderStage(const Device& device, vk::ShaderStageFlagBits stage, const ShaderCode& shader,
                         const Specialization& constants)
    : stage_(stage), module_(makeModule(device, shader)), constants_(constants) {
    for (std::uint32_t i = 0; i < constants_.size(); ++i) entries_.emplace_back(i, 4 * i, 4);
    special_ = vk::SpecializationInfo(static_cast<std::uint32_t>(entries_.size()), entries_.data(),
                                      4 * constants_.size(), constants_.data());
}

}  // namespace edgewise::vulkan
