// Lists of ids on the device, one list a cell or pixel: from counts to ordered lists.
#pragma once

#include <string>

#include "pipeline/vulkan/scan.h"

namespace edgewise::vulkan {

/// ids[offsets[c]] .. ids[offsets[c + 1]], ascending. More room follows in `ids` than it has entries: it is
/// what they are sorted with.
struct DeviceLists {
    Resource offsets, ids;
};

/// Of lists that the graph has run: entries of all together.
inline std::size_t entriesOf(const PassGraph& graph, Resource offsets, std::size_t lists) {
    return graph[offsets].read<std::uint32_t>(1, lists * sizeof(std::uint32_t))[0];
}

/// Sorts lists. Outlives the runs of the graphs that it adds to.
class ListOrder {
  public:
    explicit ListOrder(const Device& device);

    /// Room for the ids that `offsets` promises, known once they are; throws FailureError then where the
    /// device binds no buffer as large. Run the graph for the offsets alone to find out, and tile.
    Resource addRoom(PassGraph& graph, const std::string& name, Resource offsets, std::size_t lists);

    /// Each list of ids ascending. Those of more than kSortLongest ids are sorted by the host.
    void addSort(PassGraph& graph, const std::string& name, const DeviceLists& lists, std::size_t count);

  private:
    const Device& device_;
    ComputePass sort_;
};

}  // namespace edgewise::vulkan
