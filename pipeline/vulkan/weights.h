// Weights on the device: the visible segments around a box of pixels become the entries of its pixels, with
// the bits of pipeline/weights.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "pipeline/vulkan/scan.h"
#include "pipeline/vulkan/weight_kernel.h"
#include "pipeline/vulkan/weight_lists.h"
#include "pipeline/weights.h"

namespace edgewise::vulkan {

/// The entries of a box, pixel by pixel in rows.
struct WeightEntries {
    Resource offsets;                    ///< uint by pixel, and the end
    Resource owners;                     ///< uint by entry, ascending within a pixel
    Resource weights;                    ///< int64 by entry, units of 2^-60
    std::function<std::size_t()> count;  ///< of entries; known once `offsets` is
};

/// What all boxes came to.
struct WeightReport {
    std::uint64_t terms = 0, interior_pixels = 0, pairs = 0, label_conflicts = 0;
    std::uint64_t handed = 0;  ///< pixels whose border rounding leaves in doubt: made by the host
};

/// Outlives the runs of the graphs that it adds to.
class WeightPasses {
  public:
    WeightPasses(const Device& device, const Prefilter& filter, const WeightOptions& options);

    /// What the boxes of an area share; nullopt where it has more than the device is given at once: halve it.
    std::optional<WeightLists> listsOf(const WeightInput& input) { return lists_.make(input); }

    /// Of whole tiles, but for the area's end; nullopt where the box has more owners or pairs of segment
    /// and pixel than are weighed at once: halve it. The lists outlive the graph's runs.
    std::optional<WeightEntries> addTo(PassGraph& graph, const WeightLists& lists, const PixelBox& box);

    const WeightReport& report() const { return report_; }

  private:
    struct Job;
    void addPairs(PassGraph& graph, const std::shared_ptr<Job>& job);
    void addTerms(PassGraph& graph, const std::shared_ptr<Job>& job);
    void addFinish(PassGraph& graph, const std::shared_ptr<Job>& job);
    void addFill(PassGraph& graph, const std::shared_ptr<Job>& job);
    void recordPairs(const PassContext& pass, const Job& job);
    void recordTerms(const PassContext& pass, const Job& job);
    void makeOnHost(const PassGraph& graph, Job& job);

    const Device& device_;
    const Prefilter filter_;
    const WeightOptions options_;
    WeightKernel kernel_;
    Buffer numbers_;
    WeightListPasses lists_;
    ComputePass pairs_, terms_, finish_, fill_;
    Scan scan_;
    WeightReport report_;
};

}  // namespace edgewise::vulkan
