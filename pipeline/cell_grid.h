// A lattice of square cells over the film, in whole pixels.
#pragma once

#include <cstddef>

#include "analytic/cell_overlap.h"
#include "analytic/visibility.h"

namespace edgewise {

struct CellGrid {
    Window px;  ///< a whole number of cells
    int columns = 0, rows = 0;

    explicit CellGrid(const Window& window) : px(cellWindow(window)) {
        columns = (px.x1 - px.x0) / kCellPx;
        rows = (px.y1 - px.y0) / kCellPx;
    }
    std::size_t size() const { return static_cast<std::size_t>(columns) * rows; }
    std::size_t index(int column, int row) const { return static_cast<std::size_t>(row) * columns + column; }
    Cell cell(std::size_t i) const {
        const double x = px.x0 + kCellPx * static_cast<double>(i % columns);
        const double y = px.y0 + kCellPx * static_cast<double>(i / columns);
        return {{x, y}, {x + kCellPx, y + kCellPx}};
    }
    /// The cell, clamped to the grid, that holds a coordinate.
    int columnOf(double x) const { return f64::clampedCell(x, px.x0, columns); }
    int rowOf(double y) const { return f64::clampedCell(y, px.y0, rows); }
};

}  // namespace edgewise
