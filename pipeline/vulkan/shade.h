// Shading on the device: a colour and an alpha for every (pixel, owner) entry, with the bits of
// pipeline/shade.
#pragma once

#include <functional>

#include "pipeline/vulkan/compute_pass.h"
#include "pipeline/vulkan/pass_graph.h"
#include "pipeline/vulkan/scene_upload.h"

namespace edgewise::vulkan {

/// What the entries of a box of pixels are, pixel by pixel in rows.
struct ShadeEntries {
    Resource triangles;                                 ///< GpuTriangle: all of ScreenScene::triangles
    Resource offsets;                                   ///< uint by pixel, and the end
    Resource owners;                                    ///< uint by entry
    std::optional<Resource> stack_first, stack_layers;  ///< StackTables, where there are stacks
    std::optional<Resource> point_ends, points;         ///< ShadingPoints: uint by entry, two doubles a point
    std::function<PixelBox()> box;
    std::function<std::size_t()> count;  ///< of entries; asked when the pass is due
};

/// Which pixel of a box an entry belongs to; `offsets` as in ShadeEntries.
std::size_t pixelOfEntry(const PassGraph& graph, Resource offsets, const PixelBox& box, std::size_t entry);

/// The host's Shade of an entry, for those that the device hands back.
using ShadeEntry = std::function<Shade(std::size_t entry)>;

/// Outlives the runs of the graphs that it adds to.
class ShadePass {
  public:
    ShadePass(const Device& device, const ShadeTables& tables);

    /// By entry four doubles: colour and alpha. An entry whose loops would take more turns than a device
    /// grants (stacks of many layers at many points) is handed to `on_host`.
    Resource addTo(PassGraph& graph, const ShadeEntries& entries, const ShadeEntry& on_host);

    /// Of the last run.
    std::size_t handedBack() const { return handed_back_; }

    const SceneUpload& scene() const { return scene_; }

  private:
    void record(const PassContext& pass, const ShadeEntries& entries, std::optional<Resource> entry_pixels,
                Resource colors, Resource status);
    Resource addSigning(PassGraph& graph, const ShadeEntries& entries);
    void finish(const PassGraph& graph, const ShadeEntries& entries, const ShadeEntry& on_host,
                Resource colors, Resource status);

    std::uint32_t uses_, most_signed_;
    bool may_hand_back_;
    SceneUpload scene_;
    ComputePass sign_, shade_;
    std::size_t handed_back_ = 0;
};

}  // namespace edgewise::vulkan
