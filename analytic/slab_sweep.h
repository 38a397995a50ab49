// Visibility of a leaf: a cell is cut into slabs at every event; in a slab the owners are a one-dimensional
// question.
#pragma once

#include <memory>
#include <span>

#include "analytic/cell.h"

namespace edgewise {

/// Holds the scratch memory of one thread.
class SlabSweep {
  public:
    SlabSweep();
    ~SlabSweep();

    /// The owners of `cell` among `triangles` (indices into scene.triangles), appended to `out`.
    /// `origin`: a grid point near the cell, the frame of its arithmetic. Throws LayerLimit.
    void run(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
             std::span<const std::uint32_t> triangles, const VisibilityOptions& options, CellOutput& out);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace edgewise
