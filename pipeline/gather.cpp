#include "pipeline/gather.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <memory>

#include "pipeline/for_cells.h"

namespace edgewise {
namespace {

using Counters = std::vector<std::atomic<std::uint32_t>>;

/// Which of the cells around a triangle it meets: bit i stands for the i-th, row by row.
using CellMask = std::uint64_t;

/// Two passes over triangles and their cells: what the first found out, the second does not ask again.
class CellPasses {
  public:
    CellPasses(const ScreenScene& scene, const CellGrid& grid)
        : scene_(scene),
          grid_(grid),
          masks_(std::make_unique_for_overwrite<CellMask[]>(scene.triangles.size())) {}

    template <class Visit>
    void first(const Visit& visit) {
        inParallel([&](std::size_t t) {
            masks_[t] = 0;
            const CellBox box = cellsAround(scene_.triangles[t], grid_);
            forCellsIn(scene_.triangles[t], box, grid_, [&](std::size_t cell, std::size_t i) {
                if (i < kBits) masks_[t] |= CellMask{1} << i;
                visit(cell);
            });
        });
    }

    template <class Visit>
    void second(const Visit& visit) const {
        inParallel([&](std::size_t t) {
            const CellBox box = cellsAround(scene_.triangles[t], grid_);
            const auto id = static_cast<std::uint32_t>(t);
            if (box.size() > kBits)
                return forCellsIn(scene_.triangles[t], box, grid_,
                                  [&](std::size_t cell, std::size_t) { visit(cell, id); });
            for (CellMask left = masks_[t]; left != 0; left &= left - 1)
                visit(box.cell(static_cast<std::size_t>(std::countr_zero(left)), grid_), id);
        });
    }

  private:
    static constexpr std::size_t kBits = 64;

    template <class Body>
    void inParallel(const Body& body) const {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, scene_.triangles.size(), 512),
                          [&](const auto& range) {
                              for (std::size_t t = range.begin(); t < range.end(); ++t) body(t);
                          });
    }

    const ScreenScene& scene_;
    const CellGrid& grid_;
    std::unique_ptr<CellMask[]> masks_;
};

}  // namespace

IdLists gather(const ScreenScene& scene, const CellGrid& grid) {
    Counters histogram(grid.size());
    CellPasses passes(scene, grid);
    passes.first([&](std::size_t cell) { histogram[cell].fetch_add(1, std::memory_order_relaxed); });
    std::vector<std::uint32_t> counts(grid.size());
    for (std::size_t i = 0; i < counts.size(); ++i)
        counts[i] = histogram[i].exchange(0, std::memory_order_relaxed);
    IdLists lists;
    lists.offsets = offsetsFromCounts(counts);
    lists.ids.resize(lists.offsets.back());
    passes.second([&](std::size_t cell, std::uint32_t triangle) {
        const std::size_t slot = histogram[cell].fetch_add(1, std::memory_order_relaxed);
        lists.ids[lists.offsets[cell] + slot] = triangle;
    });
    tbb::parallel_for(std::size_t{0}, grid.size(), [&](std::size_t cell) {
        const auto begin = lists.ids.begin() + static_cast<std::ptrdiff_t>(lists.offsets[cell]);
        const auto end = lists.ids.begin() + static_cast<std::ptrdiff_t>(lists.offsets[cell + 1]);
        if (!std::is_sorted(begin, end)) std::sort(begin, end);
    });
    return lists;
}

}  // namespace edgewise
