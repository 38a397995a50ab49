// Visibility: triangle lists of cells become the visible map, on all threads.
#pragma once

#include "pipeline/cell_grid.h"
#include "pipeline/progress.h"
#include "pipeline/scan.h"

namespace edgewise {

struct VisibilityStageOptions {
    VisibilityOptions cell;
    glm::dvec2 film_offset_px{0.0};  ///< of the film's pixels on the screen, for messages
    bool skip_empty = true;          ///< a cell without triangles is the background's, and nothing is swept
};

/// The map of the grid's cells. Bit-identical for any number of threads. Throws Interrupted when cancelled,
/// FailureError naming the pixel where more than kMostLayers triangles are seen through each other.
VisibleMap visibility(const ScreenScene& scene, const CellGrid& grid, const IdLists& lists,
                      const VisibilityStageOptions& options, Progress& progress, VisibilityCounts& counts);

}  // namespace edgewise
