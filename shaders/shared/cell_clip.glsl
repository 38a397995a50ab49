// Lines clipped to a cell: analytic/cell_clip.h. Needs carrier.glsl.

/// Cell borders lie 2^-34 px right of and below their grid position.
EDGEWISE_FN FineCoordinate border(double grid) {
    return FineCoordinate(EDGEWISE_INIT grid, EDGEWISE_REAL(5.820766091346741e-11) EDGEWISE_END);
}

/// Saturates far outside the guard band.
EDGEWISE_FN OrderKey keyIn(EDGEWISE_IN(CellFrame) frame, FineCoordinate y) {
    double offset = y.grid - frame.origin.y;
    if (!(offset < EDGEWISE_REAL(1048576.0))) return farKey(EDGEWISE_REAL(1.0));
    if (!(offset > EDGEWISE_REAL(-1048576.0))) return farKey(EDGEWISE_REAL(-1.0));
    return orderKey(y, frame.origin.y);
}

EDGEWISE_FN double localX(EDGEWISE_IN(CellFrame) frame, EDGEWISE_IN(FinePoint) p) {
    return (p.grid.x - frame.origin.x) + p.rest.x;
}

/// -1 left of the cell, 0 within its columns, +1 right of it; for abscissae on the grid.
EDGEWISE_FN int columnIn(EDGEWISE_IN(CellFrame) frame, double grid_x) {
    return grid_x <= frame.cell.min.x ? -1 : (grid_x > frame.cell.max.x ? 1 : 0);
}

EDGEWISE_FN bool runsInside(EDGEWISE_IN(LeafLine) line) { return keyLess(line.in0, line.in1); }

/// Ends of the part inside, where side borders or the upper and lower ones cut it. `from` and `to`: the side that
/// the line comes from and goes to, 0 where it stays; returns false where it does not run inside.
EDGEWISE_FN bool clipSides(EDGEWISE_IN(CellFrame) frame, EDGEWISE_INOUT(LeafLine) line, int from, int to,
                           bool from_above, bool to_below) {
    bool entered = false, left = false;
    if (from != 0) {
        line.side_before = from;
        FinePoint p = pointAtX(line.carrier, border(from < 0 ? frame.cell.min.x : frame.cell.max.x));
        OrderKey key = keyIn(frame, yOf(p));
        if (keyLess(line.in0, key)) {
            line.in0 = key;
            line.enter = p;
            entered = true;
        }
    }
    if (to != 0) {
        line.side_after = to;
        FinePoint p = pointAtX(line.carrier, border(to < 0 ? frame.cell.min.x : frame.cell.max.x));
        OrderKey key = keyIn(frame, yOf(p));
        if (keyLess(key, line.in1)) {
            line.in1 = key;
            line.exit = p;
            left = true;
        }
    }
    if (!runsInside(line)) return false;
    if (from_above && !entered) line.enter = pointAtY(line.carrier, border(frame.cell.min.y));
    if (to_below && !left) line.exit = pointAtY(line.carrier, border(frame.cell.max.y));
    line.slope = slopeOf(line.carrier);
    double x0 = localX(frame, line.enter), x1 = localX(frame, line.exit);
    line.x_low = min(x0, x1);
    line.x_high = max(x0, x1);
    return true;
}

/// line.carrier, an edge that is not horizontal, clipped. False where it neither runs inside nor left of the cell.
EDGEWISE_FN bool clipEdge(EDGEWISE_IN(CellFrame) frame, EDGEWISE_INOUT(LeafLine) line) {
    dvec2 a = line.carrier.a, b = line.carrier.b;
    OrderKey ka = orderKey(FineCoordinate(EDGEWISE_INIT a.y, EDGEWISE_REAL(0.0) EDGEWISE_END), frame.origin.y);
    OrderKey kb = orderKey(FineCoordinate(EDGEWISE_INIT b.y, EDGEWISE_REAL(0.0) EDGEWISE_END), frame.origin.y);
    if (!keyLess(frame.top, kb) || !keyLess(ka, frame.bottom)) return false;
    bool from_above = keyLess(ka, frame.top), to_below = keyLess(frame.bottom, kb);
    line.y0 = from_above ? frame.top : ka;
    line.y1 = to_below ? frame.bottom : kb;
    line.in0 = line.y0;
    line.in1 = line.y1;
    int from = columnIn(frame, a.x), to = columnIn(frame, b.x);
    if (from == to && from != 0) {
        line.side_before = from;
        line.side_after = from;
        line.in1 = line.in0;
        return from < 0;
    }
    if (keyLess(frame.top, ka)) line.enter = gridPoint(a);
    if (keyLess(kb, frame.bottom)) line.exit = gridPoint(b);
    if (!clipSides(frame, line, from, to, from_above, to_below)) return line.side_before < 0 || line.side_after < 0;
    return true;
}

/// line.carrier, a line of equal depth that is not horizontal, clipped. False where it does not run inside.
EDGEWISE_FN bool clipDepthLine(EDGEWISE_IN(CellFrame) frame, EDGEWISE_INOUT(LeafLine) line) {
    line.y0 = frame.top;
    line.in0 = frame.top;
    line.y1 = frame.bottom;
    line.in1 = frame.bottom;
    double slope = slopeOf(line.carrier);
    int from = 0;
    if (slope != EDGEWISE_REAL(0.0)) {
        from = slope > EDGEWISE_REAL(0.0) ? -1 : 1;
    } else {
        FineCoordinate x = xOf(pointAtY(line.carrier, border(frame.cell.min.y)));
        bool right_of_left = difference(x, border(frame.cell.min.x)) > EDGEWISE_REAL(0.0);
        if (!right_of_left || difference(x, border(frame.cell.max.x)) > EDGEWISE_REAL(0.0)) return false;
    }
    return clipSides(frame, line, from, -from, true, true);
}

/// A horizontal edge, clipped. False where it does not meet the cell.
EDGEWISE_FN bool clipHorizontalEdge(EDGEWISE_IN(CellFrame) frame, EDGEWISE_IN(Carrier) edge,
                                    EDGEWISE_OUT(LeafHorizontal) clipped) {
    FineCoordinate y = FineCoordinate(EDGEWISE_INIT edge.a.y, EDGEWISE_REAL(0.0) EDGEWISE_END);
    FinePoint low = gridPoint(edge.b), high = gridPoint(edge.a);
    if (edge.b.x <= frame.cell.min.x) low = finePoint(border(frame.cell.min.x), y);
    if (edge.a.x > frame.cell.max.x) high = finePoint(border(frame.cell.max.x), y);
    clipped.carrier = edge;
    clipped.key = orderKey(y, frame.origin.y);
    clipped.y = y;
    clipped.low = low;
    clipped.high = high;
    return !(edge.a.y <= frame.cell.min.y || edge.a.y > frame.cell.max.y || edge.a.x <= frame.cell.min.x ||
             edge.b.x > frame.cell.max.x);
}
