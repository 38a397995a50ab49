#include "pipeline/gather.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "pipeline/for_cells.h"

namespace edgewise {
namespace {

using Counters = std::vector<std::atomic<std::uint32_t>>;

template <class Visit>
void forTrianglesInParallel(const ScreenScene& scene, const CellGrid& grid, Visit&& visit) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, scene.triangles.size(), 512), [&](const auto& range) {
            for (std::size_t t = range.begin(); t < range.end(); ++t)
                forCellsOf(scene.triangles[t], grid,
                           [&](std::size_t cell) { visit(cell, static_cast<std::uint32_t>(t)); });
        });
}

}  // namespace

IdLists gather(const ScreenScene& scene, const CellGrid& grid) {
    Counters histogram(grid.size());
    forTrianglesInParallel(scene, grid, [&](std::size_t cell, std::uint32_t) {
        histogram[cell].fetch_add(1, std::memory_order_relaxed);
    });
    std::vector<std::uint32_t> counts(grid.size());
    for (std::size_t i = 0; i < counts.size(); ++i)
        counts[i] = histogram[i].exchange(0, std::memory_order_relaxed);
    IdLists lists;
    lists.offsets = offsetsFromCounts(counts);
    lists.ids.resize(lists.offsets.back());
    forTrianglesInParallel(scene, grid, [&](std::size_t cell, std::uint32_t triangle) {
        const std::size_t slot = histogram[cell].fetch_add(1, std::memory_order_relaxed);
        lists.ids[lists.offsets[cell] + slot] = triangle;
    });
    tbb::parallel_for(std::size_t{0}, grid.size(), [&](std::size_t cell) {
        const auto begin = lists.ids.begin();
        std::sort(begin + static_cast<std::ptrdiff_t>(lists.offsets[cell]),
                  begin + static_cast<std::ptrdiff_t>(lists.offsets[cell + 1]));
    });
    return lists;
}

}  // namespace edgewise
