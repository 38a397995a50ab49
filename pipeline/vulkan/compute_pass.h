// A compute shader with its bindings: storage buffers, then images that it reads, and push constants.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "pipeline/vulkan/bindings.h"

namespace edgewise::vulkan {

/// Workgroups of a dispatch; each dimension is at most kMostInRow.
struct Groups {
    static constexpr std::uint32_t kMostInRow = 65535;
    std::uint32_t x, y = 1;
    /// As many as cover `count` invocations, `size` each.
    static Groups covering(std::size_t count, std::uint32_t size) {
        return {static_cast<std::uint32_t>((count + size - 1) / size)};
    }
    /// `count` of them, in rows.
    static Groups inRows(std::size_t count) {
        const auto groups = static_cast<std::uint32_t>(count), row = std::min(groups, kMostInRow);
        return {row, row == 0 ? 0 : (groups + row - 1) / row};
    }
};

/// A shader writes nothing when its push constants are 0: it is run so once, to be compiled.
class ComputePass {
  public:
    ComputePass(const Device& device, const ShaderCode& shader, BufferSlots slots, std::size_t push_bytes = 0,
                const Specialization& constants = {}, std::size_t image_count = 0);

    using Range = BufferRange;
    void dispatch(const vk::raii::CommandBuffer& commands, const std::vector<Range>& buffers, Groups groups) {
        record(commands, buffers, {}, PushBytes(), groups);
    }
    template <class Push>
    void dispatch(const vk::raii::CommandBuffer& commands, const std::vector<Range>& buffers, Groups groups,
                  const Push& push) {
        record(commands, buffers, {}, PushBytes(push), groups);
    }
    void record(const vk::raii::CommandBuffer& commands, const std::vector<Range>& buffers,
                const std::vector<vk::ImageView>& images, const PushBytes& push, Groups groups);

    /// Sets are made anew after this; call it when nothing recorded is pending.
    void forgetSets() { bindings_.forgetSets(); }

  private:
    void warmUp(const Device& device, std::size_t buffer_count, std::size_t push_bytes);

    Bindings bindings_;
    vk::raii::Pipeline pipeline_;
};

}  // namespace edgewise::vulkan
