// The front-most owner at the samples of pixels, as a rasterizer sees it: corners snapped to the device's
// subpixels, coverage by its fill rule, depths in 32-bit floats. What the sampling methods see on the device.
#pragma once

#include <memory>

#include "pipeline/film.h"
#include "pipeline/sample_pattern.h"
#include "pipeline/vulkan/compute_pass.h"
#include "pipeline/vulkan/graphics_pass.h"
#include "pipeline/vulkan/guard_clip.h"
#include "pipeline/vulkan/layouts.h"
#include "pipeline/vulkan/pass_graph.h"

namespace edgewise::vulkan {

/// How the samples of a pixel come about.
enum class RasterForm {
    kLattice,       ///< K x K samples: a target K times as large
    kMultisampled,  ///< in hardware, where the device has the standard locations
    kShifted        ///< a draw a sample, of the scene shifted
};

/// The device's own samples where it has them.
RasterForm rasterFormFor(const SamplePattern& pattern, const DeviceTraits& traits);

/// In words.
std::string describe(RasterForm form, const SamplePattern& pattern);

/// Outlives the runs of the graphs that it adds to. Of opaque scenes; the first drawn of equal depths, which
/// is the lower index, stays.
class Raster {
  public:
    Raster(const Device& device, const ScreenScene& scene, const SamplePattern& pattern, RasterForm form);
    Raster(const Device& device, const ScreenScene& scene, const SamplePattern& pattern)
        : Raster(device, scene, pattern, rasterFormFor(pattern, device.traits())) {}

    RasterForm form() const { return form_; }

    /// Whether one target and one buffer hold the samples of such a window.
    bool fits(int width, int height) const;

    /// Owners of all samples of a window that fits, uint, in rows of width * pattern.columns from the top.
    /// `triangles` and `planes` are the scene's.
    Resource addTo(PassGraph& graph, Resource triangles, Resource planes, const PixelBox& window);

  private:
    struct Job;
    void addDraw(PassGraph& graph, const std::shared_ptr<Job>& job, std::size_t sample);
    RasterPush pushFor(const PixelBox& window, std::size_t sample) const;
    CollectPush collectFor(const PixelBox& window, std::size_t sample) const;

    const Device& device_;
    const ScreenScene& scene_;
    const SamplePattern& pattern_;
    RasterForm form_;
    double depth_scale_ = 1.0, depth_offset_ = 0.0;
    GraphicsPass draw_;
    ComputePass collect_;
    std::shared_ptr<RenderTarget> target_;  ///< of the last window: most have one size
};

}  // namespace edgewise::vulkan
