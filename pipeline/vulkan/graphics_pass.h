// A graphics pipeline with its bindings: vertices are pulled from storage buffers, fragments write to them,
// and to the target's images where it has some.
#pragma once

#include <string>
#include <vector>

#include "pipeline/vulkan/bindings.h"
#include "pipeline/vulkan/render_target.h"

namespace edgewise::vulkan {

struct GraphicsShaders {
    std::string vertex, geometry, fragment;  ///< geometry: "" for none
};

struct GraphicsOptions {
    vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleList;
    TargetFormat target;
    /// Which depth passes; the nearer one is the greater.
    vk::CompareOp depth_compare = vk::CompareOp::eGreater;
    bool overestimate = false;  ///< with VK_EXT_conservative_rasterization: every pixel that is touched
    std::vector<vk::PipelineColorBlendAttachmentState> blend = {};  ///< empty: colours replace
    /// The viewport reaches this much farther than the target on each side: what lies there is not clipped.
    std::uint32_t guard_px = 0;
};

/// Vertices of a draw; a shader sees gl_VertexIndex from `first` on. Or a buffer holds these numbers:
/// VkDrawIndirectCommand.
struct Draw {
    std::uint32_t vertices = 0, instances = 1, first = 0;
    const Buffer* indirect = nullptr;
};

class GraphicsPass {
  public:
    GraphicsPass(const Device& device, const GraphicsShaders& shaders, std::size_t buffer_count,
                 std::size_t push_bytes, const GraphicsOptions& options,
                 const Specialization& constants = {});

    /// Clears the target's images (colour to these bits, depth to 0) and draws on all of it.
    void draw(const vk::raii::CommandBuffer& commands, const RenderTarget& target,
              const std::vector<BufferRange>& buffers, const PushBytes& push, const Draw& draw,
              const vk::ClearColorValue& clear = {});

    /// Sets are made anew after this; call it when nothing recorded is pending.
    void forgetSets() { bindings_.forgetSets(); }

  private:
    GraphicsOptions options_;
    Bindings bindings_;
    vk::raii::RenderPass render_pass_;
    vk::raii::Pipeline pipeline_;
};

}  // namespace edgewise::vulkan
