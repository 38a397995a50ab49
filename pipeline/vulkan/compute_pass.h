// A compute shader with its bindings: storage buffers 0, 1, 2, ... of set 0, and push constants.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/vulkan/buffer.h"

namespace edgewise::vulkan {

/// Values of constant_id 0, 1, 2, ...: 32-bit words.
using Specialization = std::vector<std::uint32_t>;

/// Workgroups of a dispatch; each dimension is at most 65535.
struct Groups {
    std::uint32_t x, y = 1;
    /// As many as cover `count` invocations, `size` each.
    static Groups covering(std::size_t count, std::uint32_t size) {
        return {static_cast<std::uint32_t>((count + size - 1) / size)};
    }
};

class ComputePass {
  public:
    ComputePass(const Device& device, std::string_view shader, std::size_t buffer_count,
                std::size_t push_bytes = 0, const Specialization& constants = {});

    /// A binding: a buffer, or a part of one.
    struct Range {
        vk::Buffer buffer;
        std::size_t offset = 0, bytes = VK_WHOLE_SIZE;
        Range(const Buffer& whole) : buffer(whole.handle()) {}
        Range(const Buffer& part, std::size_t from, std::size_t size)
            : buffer(part.handle()), offset(from), bytes(size) {}
    };
    void dispatch(const vk::raii::CommandBuffer& commands, const std::vector<Range>& buffers, Groups groups) {
        record(commands, buffers, nullptr, 0, groups);
    }
    template <class Push>
    void dispatch(const vk::raii::CommandBuffer& commands, const std::vector<Range>& buffers, Groups groups,
                  const Push& push) {
        static_assert(std::is_trivially_copyable_v<Push>);
        record(commands, buffers, &push, sizeof push, groups);
    }

    /// Sets are made anew after this; call it when nothing recorded is pending.
    void forgetSets() { sets_.clear(), pools_.clear(); }

  private:
    void record(const vk::raii::CommandBuffer& commands, const std::vector<Range>& buffers, const void* push,
                std::size_t push_bytes, Groups groups);
    vk::DescriptorSet makeSet(const std::vector<Range>& buffers);

    const Device* device_;
    std::size_t buffer_count_, push_bytes_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    vk::raii::Pipeline pipeline_;
    std::vector<vk::raii::DescriptorPool> pools_;
    std::vector<vk::DescriptorSet> sets_;
};

}  // namespace edgewise::vulkan
