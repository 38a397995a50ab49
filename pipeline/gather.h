// Gather: which triangles may be seen in which cell. Histogram, prefix scan, fill: the paper's first stage,
// with a cell of visibility in the place of a sample (NSAA section 3.1).
#pragma once

#include "pipeline/cell_grid.h"
#include "pipeline/scan.h"

namespace edgewise {

/// Ids of ScreenScene::triangles, ascending in each cell. Conservative: no triangle that meets a cell is
/// missing.
IdLists gather(const ScreenScene& scene, const CellGrid& grid);

}  // namespace edgewise
