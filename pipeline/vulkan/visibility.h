// Visibility on the device: lists of candidates become the visible map, in every bit the one that
// pipeline/visibility makes.
#pragma once

#include "pipeline/cell_grid.h"
#include "pipeline/vulkan/compute_pass.h"
#include "pipeline/vulkan/pass_graph.h"

namespace edgewise::vulkan {

/// What is not in buffers: the scene, for cells that are handed back to the host's code.
struct VisibilityInput {
    const ScreenScene& scene;
    const CellGrid& grid;
    VisibilityOptions options;
};

/// What was done where.
struct VisibilityReport {
    VisibilityCounts counts;
    std::size_t cells = 0;   ///< the lattice's and the parts of split ones
    std::size_t leaves = 0;  ///< on the device
    std::size_t exact = 0;   ///< of them, swept once more with exact comparisons
    std::size_t handed = 0;  ///< cells and parts of cells handed back to the host
    std::size_t dispatches = 0;
    double device_seconds = 0.0, host_seconds = 0.0, merge_seconds = 0.0;
};

struct MapResources {
    Resource segments;     ///< GpuSegment, sorted by (line, position)
    Resource lines;        ///< CarrierLine
    Resource row_offsets;  ///< of each row of the grid, into row_owners; one more than rows
    Resource row_owners;   ///< RowOwner
};

class VisibilityPasses {
  public:
    explicit VisibilityPasses(const Device& device);
    ~VisibilityPasses();

    /// From ScreenTriangles, DepthPlanes and lists of candidates by cell (offsets, one more than cells, and
    /// ids, both uint32, ids ascending in a cell). `input` is asked, and what it names is read, while the
    /// graph runs.
    MapResources addTo(PassGraph& graph, Resource triangles, Resource planes, Resource offsets, Resource ids,
                       std::function<VisibilityInput()> input);

    /// Of the graph's last run.
    const VisibilityReport& report() const;
    const VisibleMap& map() const;

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace edgewise::vulkan
