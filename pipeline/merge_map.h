// The cells' pieces become one visible map, on all threads: what analytic/merge_segments does on one.
#pragma once

#include <span>

#include "analytic/merge_segments.h"
#include "pipeline/progress.h"

namespace edgewise {

/// Joins the outputs' stacks, segments and rows (row_begin..row_end) and empties them. The map is the same
/// for any number of outputs and threads. Throws Interrupted when cancelled.
VisibleMap mergeMap(const ScreenScene& scene, std::span<CellOutput* const> outputs, int row_begin,
                    int row_end, Progress& progress);

}  // namespace edgewise
