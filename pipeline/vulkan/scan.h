// Exclusive prefix sums on the device: counts become offsets.
#pragma once

#include <string>

#include "pipeline/vulkan/compute_pass.h"
#include "pipeline/vulkan/pass_graph.h"

namespace edgewise::vulkan {

/// Outlives the runs of the graphs that it adds to.
class Scan {
  public:
    explicit Scan(const Device& device);

    /// offsets[i] = counts[0] + ... + counts[i - 1], uint; one entry more than counts, the last is the total.
    /// Sums that 32 bits do not hold are 0xffffffff.
    Resource addTo(PassGraph& graph, const std::string& name, Resource counts, std::size_t count);

  private:
    ComputePass reduce_, scan_, scan_based_;
};

}  // namespace edgewise::vulkan
