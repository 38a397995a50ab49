#include "analytic/visibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace edgewise {
namespace {

int floorToCell(int px) {
    return px - ((px % kCellPx) + kCellPx) % kCellPx;
}

}  // namespace

void VisibilityCounts::add(const VisibilityCounts& other) {
    cells += other.cells;
    certified += other.certified;
    by_events += other.by_events;
    slabs += other.slabs;
    depth_lines += other.depth_lines;
    exact_depth += other.exact_depth;
    hidden += other.hidden;
    fine_orders += other.fine_orders;
    closings += other.closings;
}

Window cellWindow(const Window& window) {
    return {floorToCell(window.x0), floorToCell(window.y0), floorToCell(window.x1 + kCellPx - 1),
            floorToCell(window.y1 + kCellPx - 1)};
}

VisibleMap visibleMap(const ScreenScene& scene, const Window& window, const VisibilityOptions& options,
                      VisibilityCounts* counts) {
    const Window cells = cellWindow(window);
    std::vector<std::uint32_t> all(scene.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    CellVisibility visibility;
    CellOutput out;
    for (int y = cells.y0; y < cells.y1; y += kCellPx)
        for (int x = cells.x0; x < cells.x1; x += kCellPx)
            visibility.run(scene, {{x, y}, {x + kCellPx, y + kCellPx}}, all, options, out);
    VisibleMap map;
    CellOutput* const outputs[] = {&out};
    map.stacks = joinStacks(outputs);
    std::sort(out.segments.begin(), out.segments.end(), pieceBefore);
    mergeSorted(scene, out.segments, map);
    mergeRows(out.rows, cells.y0, cells.y1, map);
    if (counts) counts->add(out.counts);
    return map;
}

}  // namespace edgewise
