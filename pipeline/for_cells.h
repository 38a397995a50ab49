// The cells that a triangle may meet.
#pragma once

#include <algorithm>

#include "analytic/cell_visibility.h"
#include "pipeline/cell_grid.h"

namespace edgewise {

/// Calls visit(cell index) for every cell of the grid that the triangle may meet.
template <class Visit>
void forCellsOf(const ScreenTriangle& t, const CellGrid& grid, Visit&& visit) {
    const auto& p = t.p_px;
    const double x0 = std::min({p[0].x, p[1].x, p[2].x}), x1 = std::max({p[0].x, p[1].x, p[2].x});
    const double y0 = std::min({p[0].y, p[1].y, p[2].y}), y1 = std::max({p[0].y, p[1].y, p[2].y});
    const auto [c0, c1] = f64::cellSpan(x0, x1, grid.px.x0, grid.columns);
    const auto [r0, r1] = f64::cellSpan(y0, y1, grid.px.y0, grid.rows);
    const bool single = c0 == c1 && r0 == r1;
    const auto meets = [&](const Cell& cell) {
        return f64::cellOverlap(p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y, cell.min.x, cell.min.y,
                                cell.max.x, cell.max.y) != f64::kMisses;
    };
    for (int row = r0; row <= r1; ++row) {
        for (int column = c0; column <= c1; ++column) {
            const std::size_t i = grid.index(column, row);
            if (single || meets(grid.cell(i))) visit(i);
        }
    }
}

}  // namespace edgewise
