#include "pipeline/vulkan/gather.h"

#include <algorithm>

#include "pipeline/vulkan/layouts.h"

namespace edgewise::vulkan {
namespace {

bool hasGeometryShader(GatherForm form) {
    return form == GatherForm::kThickened || form == GatherForm::kOverestimated;
}

GraphicsShaders shadersOf(GatherForm form) {
    if (hasGeometryShader(form)) return {"gather_points.vert", "gather.geom", "gather.frag"};
    return {"gather.vert", "", "gather.frag"};
}

GraphicsOptions optionsOf(GatherForm form) {
    GraphicsOptions options;
    if (hasGeometryShader(form)) options.topology = vk::PrimitiveTopology::ePointList;
    if (form == GatherForm::kInstancedBoxes) options.topology = vk::PrimitiveTopology::eTriangleStrip;
    options.overestimate = form == GatherForm::kOverestimated;
    return options;
}

/// constant_id 0 and 1 of the raster shaders: whether they fill, and the form.
Specialization constantsOf(GatherForm form, bool fill) {
    const bool other = form == GatherForm::kInstancedBoxes || form == GatherForm::kOverestimated;
    return {fill ? 1u : 0u, other ? 1u : 0u};
}

/// The indirect command before any triangle is found wide, and what each adds to which of its words.
vk::DrawIndirectCommand emptyDraw(GatherForm form) {
    if (form == GatherForm::kInstancedBoxes) return {4, 0, 0, 0};
    return {0, 1, 0, 0};
}
Specialization drawStep(GatherForm form) {
    if (form == GatherForm::kInstancedBoxes) return {1, 1};
    return {0, form == GatherForm::kBoxes ? 6u : 1u};
}

}  // namespace

GatherForm gatherFormFor(const DeviceTraits& traits) {
    if (traits.geometry_shader && traits.conservative_rasterization) return GatherForm::kOverestimated;
    return traits.geometry_shader && traits.real_gpu ? GatherForm::kThickened : GatherForm::kBoxes;
}

/// One gather of a graph.
struct Gather::Job {
    GatherGrid grid;
    std::size_t cells;
    Resource triangles, histogram, direct, wide, draw;
    RenderTarget target;

    PushBytes push() const { return PushBytes(grid); }
    std::size_t count() const { return grid.count; }
};

Gather::Gather(const Device& device, GatherForm form)
    : device_(device),
      form_(form),
      narrow_(device, "gather_narrow.comp", kGatherBindings, sizeof(GatherGrid), drawStep(form)),
      narrow_fill_(device, "gather_narrow_fill.comp", kGatherBindings, sizeof(GatherGrid)),
      wide_(device, shadersOf(form), kGatherBindings, sizeof(GatherGrid), optionsOf(form),
            constantsOf(form, false)),
      wide_fill_(device, shadersOf(form), kGatherBindings, sizeof(GatherGrid), optionsOf(form),
                 constantsOf(form, true)),
      scan_(device),
      order_(device) {}

DeviceLists Gather::addTo(PassGraph& graph, Resource triangles, std::size_t count, const CellGrid& grid) {
    const std::size_t cells = grid.size();
    const auto words = [](std::size_t n) { return [n] { return n * sizeof(uint); }; };
    const auto side = [](int n) { return static_cast<std::uint32_t>(std::max(n, 1)); };
    const auto job =
        std::make_shared<Job>(Job{{grid.px.x0, grid.px.y0, grid.columns, grid.rows, static_cast<uint>(count)},
                                  cells,
                                  triangles,
                                  graph.buffer("gather histogram", words(cells)),
                                  graph.buffer("gather direct", words(count)),
                                  graph.buffer("gather wide", words(count)),
                                  graph.buffer("gather draw", [] { return sizeof(vk::DrawIndirectCommand); }),
                                  RenderTarget(device_, "cells", {}, side(grid.columns), side(grid.rows))});
    addCount(graph, job);
    const Resource offsets = scan_.addTo(graph, "gather", job->histogram, cells);
    const DeviceLists lists{offsets, order_.addRoom(graph, "gather", offsets, cells)};
    addFill(graph, job, lists);
    order_.addSort(graph, "gather", lists, cells);
    return lists;
}

void Gather::addCount(PassGraph& graph, const std::shared_ptr<Job>& job) {
    graph.add(
        "gather clear",
        {.reads = {}, .writes = {job->histogram, job->draw}, .record = [=, this](const PassContext& pass) {
             pass.commands.fillBuffer(pass[job->histogram].handle(), 0, VK_WHOLE_SIZE, 0);
             pass.commands.updateBuffer<vk::DrawIndirectCommand>(pass[job->draw].handle(), 0,
                                                                 emptyDraw(form_));
         }});
    graph.add("gather narrow", {.reads = {job->triangles, job->histogram, job->draw},
                                .writes = {job->histogram, job->draw, job->direct, job->wide},
                                .record = [=, this](const PassContext& pass) {
                                    const Buffer& none = pass[job->histogram];
                                    narrow_.dispatch(
                                        pass.commands,
                                        {pass[job->triangles], pass[job->histogram], pass[job->direct],
                                         pass[job->wide], pass[job->draw], none, none},
                                        Groups::covering(job->count(), 64), job->grid);
                                }});
    graph.add("gather wide", {.reads = {job->triangles, job->histogram, job->wide, job->draw},
                              .writes = {job->histogram},
                              .record = [=, this](const PassContext& pass) {
                                  const Buffer& none = pass[job->histogram];
                                  wide_.draw(pass.commands, job->target,
                                             {pass[job->triangles], pass[job->histogram], none,
                                              pass[job->wide], none, none, none},
                                             job->push(), {.indirect = &pass[job->draw]});
                              }});
}

void Gather::addFill(PassGraph& graph, const std::shared_ptr<Job>& job, const DeviceLists& lists) {
    graph.add("gather narrow fill", {.reads = {job->triangles, job->histogram, job->direct, lists.offsets},
                                     .writes = {job->histogram, lists.ids},
                                     .record = [=, this](const PassContext& pass) {
                                         const Buffer& none = pass[job->histogram];
                                         narrow_fill_.dispatch(
                                             pass.commands,
                                             {pass[job->triangles], pass[job->histogram], pass[job->direct],
                                              none, none, pass[lists.offsets], pass[lists.ids]},
                                             Groups::covering(job->count(), 64), job->grid);
                                     }});
    graph.add("gather wide fill",
              {.reads = {job->triangles, job->histogram, job->wide, job->draw, lists.offsets},
               .writes = {job->histogram, lists.ids},
               .record = [=, this](const PassContext& pass) {
                   const Buffer& none = pass[job->histogram];
                   wide_fill_.draw(pass.commands, job->target,
                                   {pass[job->triangles], pass[job->histogram], none, pass[job->wide], none,
                                    pass[lists.offsets], pass[lists.ids]},
                                   job->push(), {.indirect = &pass[job->draw]});
               }});
}

}  // namespace edgewise::vulkan
