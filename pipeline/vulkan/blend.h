// Blending on the device: a draw over the box whose fragments each sum the entries of their pixel, in the
// owners' order, with the bits of pipeline/blend. Framebuffers blend no 64-bit floats, and fixed-point sums
// of weight times colour would be exact but not the CPU's roundings: an ordered sum needs no atomics and has
// its bits.
#pragma once

#include <functional>
#include <optional>

#include "pipeline/film.h"
#include "pipeline/image_buffer.h"
#include "pipeline/vulkan/graphics_pass.h"
#include "pipeline/vulkan/layouts.h"
#include "pipeline/vulkan/pass_graph.h"

namespace edgewise::vulkan {

/// Pixel by pixel in rows.
struct BlendEntries {
    Resource offsets;  ///< uint by pixel, and the end
    Resource weights;  ///< int64 by entry, units of 2^-60
    Resource shades;   ///< four doubles by entry
    std::function<PixelBox()> box;
};

struct BlendedPixels {
    Resource rgba;  ///< four doubles a pixel
    Resource edge;  ///< a float a pixel: 1 or 0
};

/// Of a graph that has run, into the box's part of the image.
void copyPixels(const PassGraph& graph, const BlendedPixels& from, const PixelBox& box, ImageBuffer& image);

/// Outlives the runs of the graphs that it adds to. Boxes are at most DeviceTraits::max_target_px wide and
/// high.
class BlendPass {
  public:
    explicit BlendPass(const Device& device);

    BlendedPixels addTo(PassGraph& graph, const BlendEntries& entries);

    /// Pixels of the last run with more entries than a device sums in one loop: summed on the host.
    std::size_t handedBack() const { return handed_back_; }

  private:
    void record(const PassContext& pass, const BlendEntries& entries, const BlendedPixels& out);
    void finish(const PassGraph& graph, const BlendEntries& entries, const BlendedPixels& out);

    const Device& device_;
    GraphicsPass blend_;
    std::optional<RenderTarget> target_;
    std::size_t handed_back_ = 0;
};

}  // namespace edgewise::vulkan
