#include "pipeline/bands.h"

#include <fmt/format.h>

#include <cmath>

#include "pipeline/error.h"

namespace edgewise {
namespace {

/// Bytes of the rows of cells that pixels y0 .. y1 need.
std::size_t bytesOf(const CellGrid& grid, const IdLists& lists, double y0, double y1) {
    const std::size_t first = grid.index(0, grid.rowOf(y0)),
                      last = grid.index(0, grid.rowOf(y1)) + grid.columns;
    return (lists.offsets[last] - lists.offsets[first]) * kBytesPerPair + (last - first) * kBytesPerCell;
}

}  // namespace

void requireLattice(const CellGrid& grid, std::size_t bytes) {
    constexpr std::size_t kBytesOfGather = 2 * sizeof(std::uint32_t) + sizeof(std::size_t);
    if (grid.size() > bytes / kBytesOfGather)
        throw FailureError(
            "--memory", fmt::format("{} x {} cells of {} pixels that the filter reaches need {} MiB",
                                    grid.columns, grid.rows, kCellPx, (grid.size() * kBytesOfGather) >> 20));
}

std::vector<PixelBox> bandsFor(const PixelBox& box, const CellGrid& grid, const IdLists& lists,
                               double reach_px, glm::dvec2 offset_px, std::size_t bytes) {
    std::vector<PixelBox> bands;
    const auto needs = [&](int y0, int y1) {
        return bytesOf(grid, lists, y0 + offset_px.y - reach_px, y1 + offset_px.y + reach_px);
    };
    for (int y = box.y0; y < box.y1;) {
        int end = std::min(y + kCellPx, box.y1);
        if (needs(y, end) > bytes)
            throw FailureError("--memory", fmt::format("rows {} to {} alone need {} MiB of buffers", y, end,
                                                       needs(y, end) >> 20));
        while (end < box.y1 && needs(y, std::min(end + kCellPx, box.y1)) <= bytes)
            end = std::min(end + kCellPx, box.y1);
        bands.push_back({box.x0, y, box.x1, end});
        y = end;
    }
    return bands;
}

}  // namespace edgewise
