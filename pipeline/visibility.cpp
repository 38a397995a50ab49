#include "pipeline/visibility.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "pipeline/error.h"
#include "pipeline/merge_map.h"

namespace edgewise {
namespace {

struct Worker {
    CellVisibility cells;
    CellOutput out;
};

void emptyRows(const Cell& cell, std::vector<RowPiece>& rows) {
    for (int row = static_cast<int>(cell.min.y); row < static_cast<int>(cell.max.y); ++row)
        rows.push_back({row, kBackground, cell.min.x + kBorderRestPx});
}

}  // namespace

VisibleMap visibility(const ScreenScene& scene, const CellGrid& grid, const IdLists& lists,
                      const VisibilityStageOptions& options, Progress& progress, VisibilityCounts& counts) {
    tbb::enumerable_thread_specific<Worker> workers;
    progress.stage("visibility", grid.size());
    try {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, grid.size(), 4), [&](const auto& range) {
            if (progress.cancelled()) throw Interrupted();
            Worker& worker = workers.local();
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const auto ids =
                    std::span(lists.ids).subspan(lists.offsets[i], lists.offsets[i + 1] - lists.offsets[i]);
                if (ids.empty() && options.skip_empty)
                    emptyRows(grid.cell(i), worker.out.rows);
                else
                    worker.cells.run(scene, grid.cell(i), ids, options.cell, worker.out);
            }
            progress.advance(range.size());
        });
    } catch (const LayerLimit& limit) {
        const glm::dvec2 at = limit.at_px - options.film_offset_px;
        throw FailureError(fmt::format("pixel {:.0f},{:.0f}", std::floor(at.x), std::floor(at.y)),
                           fmt::format("more than {} triangles are seen through each other", kMostLayers));
    }
    for (Worker& w : workers) counts.add(w.out.counts);
    std::vector<CellOutput*> outputs;
    for (Worker& w : workers) counts.pieces += w.out.segments.size(), outputs.push_back(&w.out);
    return mergeMap(scene, outputs, grid.px.y0, grid.px.y1, progress);
}

}  // namespace edgewise
