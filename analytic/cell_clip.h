// Lines clipped to a cell. Both cells beside a border compute the same bits for the point on it.
#pragma once

#include <cmath>

#include "analytic/cell.h"

namespace edgewise {

/// A cell and the frame of its arithmetic.
struct CellFrame {
    Cell cell;
    glm::dvec2 origin{0.0};        ///< a grid point near the cell
    OrderKey top = 0, bottom = 0;  ///< of its borders

    CellFrame() = default;
    CellFrame(const Cell& c, glm::dvec2 o);
    double localX(const FinePoint& p) const { return (p.grid.x - origin.x) + p.rest.x; }
    double localY(FineCoordinate y) const { return (y.grid - origin.y) + y.rest; }
    /// Saturates far outside the guard band.
    OrderKey key(FineCoordinate y) const;
    /// -1 left of the cell, 0 within its columns, +1 right of it; for abscissae on the grid.
    int column(double grid_x) const { return grid_x <= cell.min.x ? -1 : grid_x > cell.max.x ? 1 : 0; }
};

/// The border at a grid coordinate of a cell's corner.
inline FineCoordinate border(double grid) {
    return {grid, kBorderRestPx};
}

/// A line that is not horizontal. Between the ordinates in0 and in1 it runs inside the cell, from `enter` to
/// `exit`; between y0 and in0 it runs beside it on side_before, between in1 and y1 on side_after (-1 left, +1
/// right).
struct LeafLine {
    Carrier carrier;
    OrderKey y0, y1, in0, in1;
    int side_before = 0, side_after = 0;
    FinePoint enter, exit;
    double slope = 0.0;                ///< dx/dy
    double x_low = 0.0, x_high = 0.0;  ///< from the cell's origin, over the part inside

    bool runsInside() const { return in0 < in1; }
    /// Of abscissae in doubles, xAt() among them, px: coordinates within two cells of the origin carry
    /// roundings of 2^-48 px, the slope one of 2^-52 of itself.
    double abscissaError() const { return (1.0 + std::abs(slope)) * 0x1p-44; }
    /// Abscissa at an ordinate between in0 and in1, from the frame's origin.
    double xAt(const CellFrame& frame, FineCoordinate y) const {
        const double dy = (y.grid - enter.grid.y) + (y.rest - enter.rest.y);
        return frame.localX(enter) + dy * slope;
    }
};

/// A horizontal edge or line of equal depth, from low to high.
struct LeafHorizontal {
    Carrier carrier;
    OrderKey key;
    FineCoordinate y;
    FinePoint low, high;
};

/// line.carrier, an edge that is not horizontal, clipped. False where it neither runs inside nor left of the
/// cell.
bool clipEdge(const CellFrame& frame, LeafLine& line);

/// line.carrier, a line of equal depth that is not horizontal, clipped. False where it does not run inside.
bool clipDepthLine(const CellFrame& frame, LeafLine& line);

/// A horizontal edge, clipped. False where it does not meet the cell.
bool clipHorizontalEdge(const CellFrame& frame, const Carrier& edge, LeafHorizontal& out);

}  // namespace edgewise
