#include "pipeline/vulkan/graphics_pass.h"

#include <array>
#include <cassert>
#include <deque>

namespace edgewise::vulkan {
namespace {

vk::ShaderStageFlags stagesOf(const GraphicsShaders& shaders) {
    vk::ShaderStageFlags stages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
    if (!shaders.geometry.empty()) stages |= vk::ShaderStageFlagBits::eGeometry;
    return stages;
}

/// The parts of a pipeline that point to each other.
struct PipelineParts {
    std::deque<ShaderStage> shaders;
    std::vector<vk::PipelineShaderStageCreateInfo> stages;
    vk::PipelineVertexInputStateCreateInfo vertices;
    vk::PipelineInputAssemblyStateCreateInfo assembly;
    vk::PipelineViewportStateCreateInfo viewport{{}, 1, nullptr, 1, nullptr};
    vk::PipelineRasterizationConservativeStateCreateInfoEXT conservative{
        {}, vk::ConservativeRasterizationModeEXT::eOverestimate};
    vk::PipelineRasterizationStateCreateInfo rasterization;
    vk::PipelineMultisampleStateCreateInfo multisample;
    vk::PipelineDepthStencilStateCreateInfo depth;
    std::vector<vk::PipelineColorBlendAttachmentState> attachments;
    vk::PipelineColorBlendStateCreateInfo blend;
    std::array<vk::DynamicState, 2> dynamic{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    vk::PipelineDynamicStateCreateInfo dynamics{{}, dynamic};
};

void addShaders(const Device& device, const GraphicsShaders& shaders, const Specialization& constants,
                PipelineParts& parts) {
    using Stage = vk::ShaderStageFlagBits;
    for (const auto& [stage, name] :
         {std::pair(Stage::eVertex, shaders.vertex), std::pair(Stage::eGeometry, shaders.geometry),
          std::pair(Stage::eFragment, shaders.fragment)}) {
        if (name.empty()) continue;
        parts.shaders.emplace_back(device, stage, name, constants);
        parts.stages.push_back(parts.shaders.back().info());
    }
}

void setFixedStages(const GraphicsOptions& options, PipelineParts& parts) {
    parts.assembly.topology = options.topology;
    parts.rasterization.polygonMode = vk::PolygonMode::eFill;
    parts.rasterization.cullMode = vk::CullModeFlagBits::eNone;
    parts.rasterization.lineWidth = 1.0f;
    if (options.overestimate) parts.rasterization.pNext = &parts.conservative;
    parts.multisample.rasterizationSamples = options.target.sampleBits();
    parts.depth.depthTestEnable = parts.depth.depthWriteEnable = options.target.hasDepth();
    parts.depth.depthCompareOp = options.depth_compare;
    parts.attachments = options.blend;
    if (parts.attachments.empty() && options.target.hasColor()) {
        using Channel = vk::ColorComponentFlagBits;
        parts.attachments.emplace_back().colorWriteMask =
            Channel::eR | Channel::eG | Channel::eB | Channel::eA;
    }
    parts.blend.setAttachments(parts.attachments);
}

vk::raii::Pipeline makePipeline(const Device& device, const GraphicsShaders& shaders,
                                const GraphicsOptions& options, const Specialization& constants,
                                const vk::raii::PipelineLayout& layout, const vk::raii::RenderPass& pass) {
    PipelineParts parts;
    addShaders(device, shaders, constants, parts);
    setFixedStages(options, parts);
    const vk::GraphicsPipelineCreateInfo info({}, parts.stages, &parts.vertices, &parts.assembly, nullptr,
                                              &parts.viewport, &parts.rasterization, &parts.multisample,
                                              &parts.depth, &parts.blend, &parts.dynamics, *layout, *pass);
    return {device.handle(), nullptr, info};
}

}  // namespace

GraphicsPass::GraphicsPass(const Device& device, const GraphicsShaders& shaders, std::size_t buffer_count,
                           std::size_t push_bytes, const GraphicsOptions& options,
                           const Specialization& constants)
    : options_(options),
      bindings_(device, stagesOf(shaders), buffer_count, 0, push_bytes),
      render_pass_(makeRenderPass(device, options.target)),
      pipeline_(makePipeline(device, shaders, options, constants, bindings_.layout(), render_pass_)) {
    device.name(pipeline_, shaders.vertex + " " + shaders.geometry + " " + shaders.fragment);
}

void GraphicsPass::draw(const vk::raii::CommandBuffer& commands, const RenderTarget& target,
                        const std::vector<BufferRange>& buffers, const PushBytes& push, const Draw& draw,
                        const vk::ClearColorValue& clear) {
    const vk::Extent2D size = target.size();
    const vk::Rect2D area({0, 0}, size);
    std::vector<vk::ClearValue> clears;
    if (options_.target.hasColor()) clears.emplace_back(clear);
    if (options_.target.hasDepth()) clears.emplace_back(vk::ClearDepthStencilValue(0.0f, 0));
    commands.beginRenderPass(vk::RenderPassBeginInfo(target.renderPass(), target.framebuffer(), area, clears),
                             vk::SubpassContents::eInline);
    if (draw.indirect || (draw.vertices > 0 && draw.instances > 0)) {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
        bindings_.bind(commands, vk::PipelineBindPoint::eGraphics, buffers, {}, push);
        const auto guard = static_cast<float>(options_.guard_px);
        commands.setViewport(0, vk::Viewport(-guard, -guard, static_cast<float>(size.width) + 2.0f * guard,
                                             static_cast<float>(size.height) + 2.0f * guard, 0.0f, 1.0f));
        commands.setScissor(0, area);
        if (draw.indirect)
            commands.drawIndirect(draw.indirect->handle(), 0, 1, sizeof(vk::DrawIndirectCommand));
        else
            commands.draw(draw.vertices, draw.instances, draw.first, 0);
    }
    commands.endRenderPass();
}

}  // namespace edgewise::vulkan
