// The cells that a triangle may meet.
#pragma once

#include <algorithm>

#include "analytic/cell_visibility.h"
#include "pipeline/cell_grid.h"

namespace edgewise {

/// The cells around a triangle's bounds, counted row by row.
struct CellBox {
    f64::CellSpan columns, rows;

    std::size_t width() const { return static_cast<std::size_t>(columns.last - columns.first + 1); }
    std::size_t size() const {
        const bool empty = columns.first > columns.last || rows.first > rows.last;
        return empty ? 0 : width() * static_cast<std::size_t>(rows.last - rows.first + 1);
    }
    /// The i-th, as an index into the grid.
    std::size_t cell(std::size_t i, const CellGrid& grid) const {
        return grid.index(columns.first + static_cast<int>(i % width()),
                          rows.first + static_cast<int>(i / width()));
    }
};

inline CellBox cellsAround(const ScreenTriangle& t, const CellGrid& grid) {
    const auto& p = t.p_px;
    const auto [x0, x1] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y});
    return {f64::cellSpan(x0, x1, grid.px.x0, grid.columns), f64::cellSpan(y0, y1, grid.px.y0, grid.rows)};
}

/// Calls visit(cell index, its number in the box) for every cell of the box that the triangle may meet.
template <class Visit>
void forCellsIn(const ScreenTriangle& t, const CellBox& box, const CellGrid& grid, Visit&& visit) {
    const auto& p = t.p_px;
    const auto meets = [&](const Cell& cell) {
        return f64::cellOverlap(p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y, cell.min.x, cell.min.y,
                                cell.max.x, cell.max.y) != f64::kMisses;
    };
    const bool single = box.size() == 1;
    std::size_t number = 0;
    for (int row = box.rows.first; row <= box.rows.last; ++row) {
        for (int column = box.columns.first; column <= box.columns.last; ++column, ++number) {
            const std::size_t i = grid.index(column, row);
            if (single || meets(grid.cell(i))) visit(i, number);
        }
    }
}

}  // namespace edgewise
