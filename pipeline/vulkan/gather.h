// Gather on the device: triangles are rasterized conservatively over the cells of visibility (NSAA section
// 3.1), and every candidate is asked by the rule of pipeline/gather: the lists are the same.
#pragma once

#include <memory>

#include "pipeline/cell_grid.h"
#include "pipeline/vulkan/graphics_pass.h"
#include "pipeline/vulkan/id_lists.h"

namespace edgewise::vulkan {

/// What is rasterized of a triangle that may meet several cells. Either way no cell is lost: boxes end half a
/// pixel from every pixel's centre; thickened triangles have a margin for what a rasterizer rounds
/// (shaders/gather.geom).
enum class GatherForm {
    kBoxes,           ///< its box of cells: six vertices
    kInstancedBoxes,  ///< the same, an instance each
    kThickened,       ///< the paper's: scaled about its incircle in the geometry shader
    kOverestimated    ///< the triangle, by VK_EXT_conservative_rasterization
};

/// The fastest that the device has.
GatherForm gatherFormFor(const DeviceTraits& traits);

/// Outlives the runs of the graphs that it adds to.
class Gather {
  public:
    Gather(const Device& device, GatherForm form);
    explicit Gather(const Device& device) : Gather(device, gatherFormFor(device.traits())) {}

    /// Of the cells of the grid: ids of `triangles`, `count` GpuTriangles.
    DeviceLists addTo(PassGraph& graph, Resource triangles, std::size_t count, const CellGrid& grid);

  private:
    struct Job;
    void addCount(PassGraph& graph, const std::shared_ptr<Job>& job);
    void addFill(PassGraph& graph, const std::shared_ptr<Job>& job, const DeviceLists& lists);

    const Device& device_;
    GatherForm form_;
    ComputePass narrow_, narrow_fill_;
    GraphicsPass wide_, wide_fill_;
    Scan scan_;
    ListOrder order_;
};

}  // namespace edgewise::vulkan
