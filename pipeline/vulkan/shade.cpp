#include "pipeline/vulkan/shade.h"

#include <algorithm>
#include <cassert>

namespace edgewise::vulkan {
namespace {

constexpr std::uint32_t kGroupSize = 64;

/// Of one invocation: 4, 8 or 16 run together, each at its own pace in the worst case.
std::uint32_t mostTurns(const Device& device) {
    return device.traits().loop_turns / 16;
}

Specialization constantsOf(const Device& device, const ShadeTables& tables) {
    return {tables.uses, static_cast<std::uint32_t>(std::max<std::size_t>(tables.banks.size(), 1)),
            mostTurns(device)};
}

/// With one word, before the shaders that follow.
void fill(const PassContext& pass, Resource buffer, std::uint32_t word) {
    pass.commands.fillBuffer(pass[buffer].handle(), 0, VK_WHOLE_SIZE, word);
    const vk::MemoryBarrier filled(vk::AccessFlagBits::eTransferWrite,
                                   vk::AccessFlagBits::eShaderRead | vk::AccessFlagBits::eShaderWrite);
    pass.commands.pipelineBarrier(vk::PipelineStageFlagBits::eTransfer,
                                  vk::PipelineStageFlagBits::eComputeShader, {}, filled, {}, {});
}

}  // namespace

std::size_t pixelOfEntry(const PassGraph& graph, Resource offsets, const PixelBox& box, std::size_t entry) {
    const auto pixels = static_cast<std::size_t>(box.width()) * box.height();
    const auto begin = graph[offsets].read<std::uint32_t>(pixels + 1);
    return static_cast<std::size_t>(std::ranges::upper_bound(begin, entry) - begin.begin()) - 1;
}

ShadePass::ShadePass(const Device& device, const ShadeTables& tables)
    : uses_(tables.uses),
      most_signed_(mostTurns(device)),
      may_hand_back_((tables.uses & (kUsesStacks | kUsesPoints)) != 0 ||
                     tables.most_turns > mostTurns(device) / 2),
      scene_(device, tables),
      sign_(device, "shade_pixels.comp", kSignBindings, sizeof(SignPush)),
      shade_(device, "shade.comp", kShadeBindings, sizeof(ShadePush), constantsOf(device, tables)) {}

Resource ShadePass::addTo(PassGraph& graph, const ShadeEntries& entries, const ShadeEntry& on_host) {
    assert(!(uses_ & kUsesStacks) || entries.stack_first);
    assert(!(uses_ & kUsesPoints) || entries.point_ends);
    const Resource colors =
                       graph.buffer("shades", [entries] { return entries.count() * 4 * sizeof(double); }),
                   status = graph.buffer("shades handed back", [] { return sizeof(std::uint32_t); });
    std::vector<Resource> reads{entries.triangles, entries.offsets, entries.owners};
    for (const auto& more : {entries.stack_first, entries.stack_layers, entries.point_ends, entries.points})
        if (more) reads.push_back(*more);
    std::optional<Resource> entry_pixels;
    if (uses_ & kUsesVarying) reads.push_back(*(entry_pixels = addSigning(graph, entries)));
    graph.add("shade",
              {.reads = reads, .writes = {colors, status}, .record = [=, this](const PassContext& pass) {
                   record(pass, entries, entry_pixels, colors, status);
               }});
    if (may_hand_back_)
        graph.add("shade on the host",
                  {.reads = {status}, .writes = {colors}, .host = [=, this](const PassGraph& g) {
                       finish(g, entries, on_host, colors, status);
                   }});
    return colors;
}

/// An entry would find its pixel by a search; signed, it reads it.
Resource ShadePass::addSigning(PassGraph& graph, const ShadeEntries& entries) {
    const Resource pixels =
        graph.buffer("entry pixels", [entries] { return entries.count() * sizeof(std::uint32_t); });
    graph.add("shade pixels",
              {.reads = {entries.offsets}, .writes = {pixels}, .record = [=, this](const PassContext& pass) {
                   const PixelBox box = entries.box();
                   const auto count = static_cast<std::uint32_t>(box.width() * box.height());
                   const Groups groups = Groups::inRows(Groups::covering(count, kGroupSize).x);
                   const SignPush push{count, groups.x * kGroupSize, most_signed_};
                   fill(pass, pixels, kAbsent);
                   sign_.forgetSets();
                   sign_.dispatch(pass.commands, {pass[entries.offsets], pass[pixels]}, groups, push);
               }});
    return pixels;
}

void ShadePass::record(const PassContext& pass, const ShadeEntries& entries,
                       std::optional<Resource> entry_pixels, Resource colors, Resource status) {
    std::vector<BufferRange> buffers;
    for (int binding = 0; binding < kShadeBindings; ++binding) buffers.emplace_back(scene_.at(binding));
    const auto bind = [&](int binding, std::optional<Resource> resource) {
        if (resource) buffers[binding] = pass[*resource];
    };
    bind(kShadeOffsetsBinding, entries.offsets), bind(kShadeOwnersBinding, entries.owners);
    bind(kShadeColorsBinding, colors), bind(kShadeStatusBinding, status);
    bind(kTrianglesBinding, entries.triangles);
    bind(kStackFirstBinding, entries.stack_first), bind(kStackLayersBinding, entries.stack_layers);
    bind(kPointEndsBinding, entries.point_ends), bind(kPointsBinding, entries.points);
    bind(kEntryPixelsBinding, entry_pixels);

    const PixelBox box = entries.box();
    const auto count = static_cast<std::uint32_t>(entries.count());
    const Groups groups = Groups::inRows(Groups::covering(count, kGroupSize).x);
    const ShadePush push{box.x0,
                         box.y0,
                         static_cast<std::uint32_t>(box.width()),
                         static_cast<std::uint32_t>(box.width() * box.height()),
                         count,
                         groups.x * kGroupSize};
    fill(pass, status, 0);
    shade_.forgetSets();
    shade_.dispatch(pass.commands, buffers, groups, push);
}

void ShadePass::finish(const PassGraph& graph, const ShadeEntries& entries, const ShadeEntry& on_host,
                       Resource colors, Resource status) {
    handed_back_ = graph[status].read<std::uint32_t>(1)[0];
    if (handed_back_ == 0) return;
    const auto shades = graph[colors].read<glm::dvec4>(entries.count());
    const auto made = graph[colors].view<glm::dvec4>(shades.size());
    for (std::size_t e = 0; e < shades.size(); ++e) {
        if (shades[e].a >= 0.0) continue;
        const Shade shade = on_host(e);
        made[e] = glm::dvec4(shade.color, shade.alpha);
    }
}

}  // namespace edgewise::vulkan
