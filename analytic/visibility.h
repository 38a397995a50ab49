// The visible map of a window, cell by cell on one thread: what tests, fuzzers and library users call.
// pipeline/visibility runs the same cells on all threads.
#pragma once

#include <vector>

#include "analytic/cell_visibility.h"
#include "analytic/merge_segments.h"

namespace edgewise {

/// Visibility's cells: a lattice of kCellPx px from pixel (0, 0), whatever the window.
inline constexpr int kCellPx = 16;

/// x0 <= x < x1, y0 <= y < y1 in pixels.
struct Window {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// The window widened to whole cells.
Window cellWindow(const Window& window);

/// The map of at least `window`. Inside it, segments end at junctions only.
VisibleMap visibleMap(const ScreenScene& scene, const Window& window, const VisibilityOptions& options = {},
                      VisibilityCounts* counts = nullptr);

}  // namespace edgewise
