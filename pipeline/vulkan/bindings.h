// What the shaders of a pass are given: storage buffers 0, 1, 2, ... of set 0, sampled images after them, and
// push constants.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "pipeline/vulkan/buffer.h"

namespace edgewise::vulkan {

/// Values of constant_id 0, 1, 2, ...: 32-bit words.
using Specialization = std::vector<std::uint32_t>;

/// A binding: a buffer, or a part of one.
struct BufferRange {
    vk::Buffer buffer;
    std::size_t offset = 0, bytes = VK_WHOLE_SIZE;
    BufferRange(const Buffer& whole) : buffer(whole.handle()) {}
    BufferRange(const Buffer& part, std::size_t from, std::size_t size)
        : buffer(part.handle()), offset(from), bytes(size) {}
};

/// Bindings 0 ... count - 1 are storage buffers; but one may be a uniform buffer, for what all invocations
/// read alike.
struct BufferSlots {
    std::size_t count;
    std::optional<int> uniform;

    BufferSlots(std::size_t of, std::optional<int> uniform_one = {}) : count(of), uniform(uniform_one) {}
    vk::DescriptorType typeOf(std::size_t binding) const {
        const bool is_uniform = uniform && static_cast<std::size_t>(*uniform) == binding;
        return is_uniform ? vk::DescriptorType::eUniformBuffer : vk::DescriptorType::eStorageBuffer;
    }
};

/// Bytes of push constants.
struct PushBytes {
    const void* data = nullptr;
    std::size_t size = 0;
    PushBytes() = default;
    template <class Push>
    explicit PushBytes(const Push& push) : data(&push), size(sizeof push) {
        static_assert(std::is_trivially_copyable_v<Push>);
    }
};

/// The layout of a pass's bindings, and the sets that its commands have used.
class Bindings {
  public:
    Bindings(const Device& device, vk::ShaderStageFlags stages, BufferSlots slots, std::size_t image_count,
             std::size_t push_bytes);

    const vk::raii::PipelineLayout& layout() const { return layout_; }

    /// Images are read in the layout eShaderReadOnlyOptimal.
    void bind(const vk::raii::CommandBuffer& commands, vk::PipelineBindPoint point,
              const std::vector<BufferRange>& buffers, const std::vector<vk::ImageView>& images,
              const PushBytes& push);

    /// Sets are made anew after this; call it when nothing recorded is pending.
    void forgetSets() { sets_.clear(), pools_.clear(); }

  private:
    vk::DescriptorSet makeSet(const std::vector<BufferRange>& buffers,
                              const std::vector<vk::ImageView>& images);

    const Device* device_;
    vk::ShaderStageFlags stages_;
    BufferSlots slots_;
    std::size_t image_count_, push_bytes_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    std::vector<vk::raii::DescriptorPool> pools_;
    std::vector<vk::DescriptorSet> sets_;
};

/// A shader's name and its SPIR-V: one that the build embedded, by its name, or one compiled at run time.
struct ShaderCode {
    std::string_view name;
    std::span<const std::uint32_t> words;
    ShaderCode(std::string_view embedded);
    ShaderCode(const char* embedded) : ShaderCode(std::string_view(embedded)) {}
    ShaderCode(const std::string& embedded) : ShaderCode(std::string_view(embedded)) {}
    ShaderCode(std::string_view own_name, std::span<const std::uint32_t> module)
        : name(own_name), words(module) {}
};

/// One shader of a pipeline with its specialization constants, alive while the pipeline is made.
class ShaderStage {
  public:
    ShaderStage(const Device& device, vk::ShaderStageFlagBits stage, const ShaderCode& shader,
                const Specialization& constants);
    ShaderStage(const ShaderStage&) = delete;
    ShaderStage& operator=(const ShaderStage&) = delete;
    vk::PipelineShaderStageCreateInfo info() const { return {{}, stage_, *module_, "main", &special_}; }

  private:
    vk::ShaderStageFlagBits stage_;
    vk::raii::ShaderModule module_;
    Specialization constants_;
    std::vector<vk::SpecializationMapEntry> entries_;
    vk::SpecializationInfo special_;
};

}  // namespace edgewise::vulkan
