#include "pipeline/vulkan/blend.h"

#include <algorithm>
#include <cmath>

#include "pipeline/shading_text.h"

namespace edgewise::vulkan {
namespace {

/// That a fragment sums.
std::uint32_t mostEntries(const Device& device) {
    return device.traits().loop_turns - 500;
}

std::size_t pixelsOf(const PixelBox& box) {
    return static_cast<std::size_t>(box.width()) * box.height();
}

}  // namespace

void copyPixels(const PassGraph& graph, const BlendedPixels& from, const PixelBox& box, ImageBuffer& image) {
    const auto rgba = graph[from.rgba].read<glm::dvec4>(pixelsOf(box));
    const auto edge = graph[from.edge].read<float>(pixelsOf(box));
    for (int y = box.y0; y < box.y1; ++y) {
        const std::size_t row = static_cast<std::size_t>(y - box.y0) * box.width();
        const auto to = static_cast<std::ptrdiff_t>(image.index(box.x0, y));
        std::copy_n(rgba.begin() + row, box.width(), image.rgba.begin() + to);
        std::copy_n(edge.begin() + row, box.width(), image.edge.begin() + to);
    }
}

BlendPass::BlendPass(const Device& device)
    : device_(device),
      blend_(device, {"blend.vert", "", "blend.frag"}, kBlendBindings, sizeof(BlendPush), {},
             {mostEntries(device)}) {}

BlendedPixels BlendPass::addTo(PassGraph& graph, const BlendEntries& entries) {
    const auto box = entries.box;
    const BlendedPixels out{graph.buffer("rgba", [box] { return pixelsOf(box()) * sizeof(glm::dvec4); }),
                            graph.buffer("edge", [box] { return pixelsOf(box()) * sizeof(float); })};
    graph.add("blend", {.reads = {entries.offsets, entries.weights, entries.shades},
                        .writes = {out.rgba, out.edge},
                        .record = [=, this](const PassContext& pass) { record(pass, entries, out); }});
    graph.add("blend on the host", {.reads = {entries.offsets, entries.weights, entries.shades},
                                    .writes = {out.rgba, out.edge},
                                    .host = [=, this](const PassGraph& g) { finish(g, entries, out); }});
    return out;
}

void BlendPass::record(const PassContext& pass, const BlendEntries& entries, const BlendedPixels& out) {
    const PixelBox box = entries.box();
    const auto width = static_cast<std::uint32_t>(box.width()),
               height = static_cast<std::uint32_t>(box.height());
    if (!target_ || target_->size() != vk::Extent2D(width, height))
        target_.emplace(device_, "blended pixels", TargetFormat{}, width, height);
    blend_.forgetSets();
    blend_.draw(
        pass.commands, *target_,
        {pass[entries.offsets], pass[entries.weights], pass[entries.shades], pass[out.rgba], pass[out.edge]},
        PushBytes(BlendPush{kEdgeContrast, width, 0}), {.vertices = 3});
}

/// As pipeline/blend sums.
void BlendPass::finish(const PassGraph& graph, const BlendEntries& entries, const BlendedPixels& out) {
    const std::size_t count = pixelsOf(entries.box());
    const auto offsets = graph[entries.offsets].read<std::uint32_t>(count + 1);
    handed_back_ = 0;
    for (std::size_t p = 0; p < count; ++p) {
        if (offsets[p + 1] - offsets[p] <= mostEntries(device_)) continue;
        ++handed_back_;
        const std::size_t first = offsets[p], size = offsets[p + 1] - first;
        const auto weights = graph[entries.weights].read<std::int64_t>(size, first * sizeof(std::int64_t));
        const auto shades = graph[entries.shades].read<glm::dvec4>(size, first * sizeof(glm::dvec4));
        f64::PixelSum sum{glm::dvec3(0.0), 0, 0.0, glm::dvec3(HUGE_VAL), glm::dvec3(-HUGE_VAL)};
        for (std::size_t e = 0; e < size; ++e)
            sum = f64::withOwner(sum, weights[e], glm::dvec3(shades[e]), shades[e].a);
        graph[out.rgba].view<glm::dvec4>(count)[p] = glm::dvec4(sum.color, f64::alphaOf(sum));
        graph[out.edge].view<float>(count)[p] = f64::contrastOf(sum) > kEdgeContrast ? 1.0f : 0.0f;
    }
}

}  // namespace edgewise::vulkan
