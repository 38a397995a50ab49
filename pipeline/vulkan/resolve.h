// From the owners of samples to the owners of pixels with their weights: what shade and blend take.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/film.h"
#include "pipeline/vulkan/compute_pass.h"
#include "pipeline/vulkan/layouts.h"
#include "pipeline/vulkan/pass_graph.h"
#include "pipeline/vulkan/scan.h"

namespace edgewise::vulkan {

/// The filter at the samples around a pixel, the same for every pixel.
struct ResolveTable {
    int margin_px = 0;          ///< the window is the pixel and this many pixels around it
    int columns = 1, rows = 1;  ///< of samples a pixel
    /// Units of 2^-60, by sample of the window in rows; kResolveUnreached where the filter ends before it.
    std::vector<std::int64_t> weights;
};

extern const std::int64_t kResolveUnreached;

/// The window's samples, pixel by pixel.
struct SampleWalk {
    std::vector<WalkPlace> places;
    std::vector<std::int64_t> weights, pixel_weights;
};

/// Outlives the runs of the graphs that it adds to.
class Resolve {
  public:
    Resolve(const Device& device, const ResolveTable& table);

    /// Whether a device's loops may be as long as the table asks for.
    static bool isShortEnough(const ResolveTable& table, const DeviceTraits& traits);

    /// Lists in no order of pixels.
    struct Resolved {
        Resource counts;  ///< uint by pixel of the box: its owners, or kHandedBack
        Resource first;   ///< uint by pixel: where its list begins, or kHandedBack
        Resource owners, weights;
        Resource status;  ///< ResolveStatus; where `entries` exceeds roomFor(), the lists are not whole
        Resource mixed;   ///< uint: pixels with several owners
    };
    /// `samples` are those of the window: the box with the table's margin. The lists of pixels with more
    /// owners than an invocation holds are left to the host.
    Resolved addTo(PassGraph& graph, Resource samples, const PixelBox& box);

    /// Entries of a box that the device shades at once: a table of four doubles each has 122 MiB then, and a
    /// binding may have 128.
    static constexpr std::size_t kMostEntries = 4'000'000;

    /// Entries that the lists may have before the host adds those of its own; 0: the box has too many pixels.
    static std::size_t roomFor(const PixelBox& box);
    /// What its lists have, but for those that were handed back.
    static std::size_t entriesOf(const ResolveStatus& status) { return status.entries - status.mixed; }

    struct Lists {
        Resource offsets, owners, weights;
    };
    /// Pixel by pixel. `entries`: the sum of all counts, whose kHandedBack the host has replaced.
    Lists addOrder(PassGraph& graph, const Resolved& resolved, const PixelBox& box, std::size_t entries);

  private:
    Resolve(const Device& device, const ResolveTable& table, const SampleWalk& walk);
    void addPasses(PassGraph& graph, Resource samples, Resource uniform, const Resolved& out,
                   const PixelBox& box);
    ResolvePush pushFor(const PixelBox& box) const;

    ResolveTable table_;
    Buffer weights_, pixel_weights_, places_;
    Scan scan_;
    ComputePass uniform_, whole_, resolve_, order_;
};

}  // namespace edgewise::vulkan
