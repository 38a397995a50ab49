// Strip terms of separable kernels: int K(x) k(y) dy along the part of the segment inside the square, and crossings with
// the side x = R. Positions are taken along the line, so that no direction is singular. [E10], [E11], [E13]

/// The line in the precision of the terms: points are (foot_x + t d_x, foot_y + t d_y).
struct WorkLine {
    work foot_x, foot_y, d_x, d_y, t_a, t_b, len;
};

EDGEWISE_FN WorkLine workLineOf(EDGEWISE_IN(Line) line) {
    WorkLine out_line;
    out_line.foot_x = workOf(line.h * line.d_y);
    out_line.foot_y = workOf(-line.h * line.d_x);
    out_line.d_x = workOf(line.d_x);
    out_line.d_y = workOf(line.d_y);
    out_line.t_a = workOf(line.t_a);
    out_line.t_b = workOf(line.t_b);
    out_line.len = workOf(line.len);
    return out_line;
}

EDGEWISE_FN work horner(EDGEWISE_NUMBERS c, int count, work u) {
    work sum = splatWork(EDGEWISE_AT(c, count - 1));
    for (int i = count - 2; i >= 0; --i) sum = sum * u + EDGEWISE_AT(c, i);
    return sum;
}

/// K(y), 0 above the square and 1 below.
EDGEWISE_FN work kernelIntegral(EDGEWISE_IN(TableView) table, work y) {
    work K = splatWork(EDGEWISE_WORK(0.0));
    for (int i = 0; i < table.intervals; ++i) {
        work_mask here = y >= EDGEWISE_AT(table.knot, i);
        if (!anyLane(here)) break;
        work u = (y - EDGEWISE_AT(table.centre, i)) * EDGEWISE_AT(table.inverse_half, i);
        K = here ? horner(table.K + i * (table.k_count + 1), table.k_count + 1, u) : K;
    }
    return y < EDGEWISE_AT(table.knot, table.intervals) ? K : splatWork(EDGEWISE_WORK(1.0));
}

/// int K(x) k(y) dt over a piece inside cell (i, j). A coefficient is read once for all nodes.
EDGEWISE_FN work cellTerm(EDGEWISE_IN(TableView) table, EDGEWISE_IN(WorkLine) line, int i, int j, work t, work step) {
    int nodes = table.rule.count;
    int n = table.k_count;
    work u[kMostCellNodes], v[kMostCellNodes], K[kMostCellNodes], k[kMostCellNodes];
    EDGEWISE_UNROLL for (int q = 0; q < nodes; ++q) {
        work at = t + step * EDGEWISE_AT(table.rule.node, q);
        u[q] = (line.foot_x + at * line.d_x - EDGEWISE_AT(table.centre, i)) * EDGEWISE_AT(table.inverse_half, i);
        v[q] = (line.foot_y + at * line.d_y - EDGEWISE_AT(table.centre, j)) * EDGEWISE_AT(table.inverse_half, j);
        K[q] = splatWork(EDGEWISE_AT(table.K, i * (n + 1) + n));
        k[q] = splatWork(EDGEWISE_AT(table.k, j * n + n - 1));
    }
    for (int c = n - 1; c >= 0; --c) {
        work_number next = EDGEWISE_AT(table.K, i * (n + 1) + c);
        EDGEWISE_UNROLL for (int q = 0; q < nodes; ++q) K[q] = K[q] * u[q] + next;
    }
    for (int c = n - 2; c >= 0; --c) {
        work_number next = EDGEWISE_AT(table.k, j * n + c);
        EDGEWISE_UNROLL for (int q = 0; q < nodes; ++q) k[q] = k[q] * v[q] + next;
    }
    work sum = splatWork(EDGEWISE_WORK(0.0));
    EDGEWISE_UNROLL for (int q = 0; q < nodes; ++q) sum = sum + EDGEWISE_AT(table.rule.weight, q) * (K[q] * k[q]);
    return sum * step;
}

/// A part of the line, [from, to]; nothing where from >= to.
struct LinePart {
    work from, to;
};

/// A line that is cut along the table's cells.
struct CutLine {
    WorkLine line;
    work inverse_x, inverse_y;
    work_mask rightwards;
    LinePart whole;
};

EDGEWISE_FN CutLine cutLineOf(EDGEWISE_IN(WorkLine) line, work t1, work t2) {
    CutLine cut;
    cut.line = line;
    cut.inverse_x = EDGEWISE_WORK(1.0) / nonZeroWork(line.d_x);
    cut.inverse_y = EDGEWISE_WORK(1.0) / nonZeroWork(line.d_y);
    cut.rightwards = nonZeroWork(line.d_x) > EDGEWISE_WORK(0.0);
    cut.whole.from = t1;
    cut.whole.to = t2;
    return cut;
}

EDGEWISE_FN LinePart between(EDGEWISE_IN(LinePart) part, work one, work other) {
    LinePart inner_part;
    inner_part.from = larger(part.from, smaller(one, other));
    inner_part.to = smaller(part.to, larger(one, other));
    return inner_part;
}

/// What of the line column i holds. The last one has no right border: whether the segment leaves there was decided by
/// its ends.
EDGEWISE_FN LinePart columnPart(EDGEWISE_IN(TableView) table, EDGEWISE_IN(CutLine) cut, int i) {
    work far = splatWork(kFar);
    work before = (EDGEWISE_AT(table.knot, i) - cut.line.foot_x) * cut.inverse_x;
    work border = (EDGEWISE_AT(table.knot, i + 1) - cut.line.foot_x) * cut.inverse_x;
    return between(cut.whole, before, i + 1 < table.intervals ? border : (cut.rightwards ? far : -far));
}

/// What row j holds of a column's part.
EDGEWISE_FN LinePart rowPart(EDGEWISE_IN(TableView) table, EDGEWISE_IN(CutLine) cut, int j, EDGEWISE_IN(LinePart) column) {
    work before = (EDGEWISE_AT(table.knot, j) - cut.line.foot_y) * cut.inverse_y;
    work after = (EDGEWISE_AT(table.knot, j + 1) - cut.line.foot_y) * cut.inverse_y;
    return between(column, before, after);
}

/// int K(x) k(y) dt over the part in cell (i, j), 0 where there is none.
EDGEWISE_FN work partTerm(EDGEWISE_IN(TableView) table, EDGEWISE_IN(CutLine) cut, int i, int j, EDGEWISE_IN(LinePart) part) {
    // the whole segment's length is known better than t_b - t_a
    work_mask whole = EDGEWISE_BOTH(part.from == cut.line.t_a, part.to == cut.line.t_b);
    work here = cellTerm(table, cut.line, i, j, part.from, whole ? cut.line.len : part.to - part.from);
    return part.from < part.to ? here : splatWork(EDGEWISE_WORK(0.0));
}

#ifdef EDGEWISE_BY_INVOCATION
/// int K(x) k(y) dt over [t1, t2], in the fixed order of the cells; each invocation visits its own: those that run
/// together all do what one of them does.
work stripSum(TableView table, WorkLine line, work t1, work t2) {
    CutLine cut = cutLineOf(line, t1, t2);
    int met[2 * kMostIntervals + 1], count = 0;
    for (int i = 0; i < table.intervals; ++i) {
        LinePart column = columnPart(table, cut, i);
        for (int j = 0; j < table.intervals && column.from < column.to; ++j) {
            LinePart part = rowPart(table, cut, j, column);
            if (part.from < part.to && count <= 2 * kMostIntervals) met[count++] = i * table.intervals + j;
        }
    }
    work sum = splatWork(EDGEWISE_WORK(0.0));
    for (int k = 0; k < count; ++k) {
        int i = met[k] / table.intervals, j = met[k] % table.intervals;
        sum = sum + partTerm(table, cut, i, j, rowPart(table, cut, j, columnPart(table, cut, i)));
    }
    return sum;
}
#else
/// int K(x) k(y) dt over [t1, t2], cell by cell in a fixed order: a cell that a lane does not meet adds 0 to it.
EDGEWISE_FN work stripSum(EDGEWISE_IN(TableView) table, EDGEWISE_IN(WorkLine) line, work t1, work t2) {
    CutLine cut = cutLineOf(line, t1, t2);
    work sum = splatWork(EDGEWISE_WORK(0.0));
    for (int i = 0; i < table.intervals; ++i) {
        LinePart column = columnPart(table, cut, i);
        if (!anyLane(column.from < column.to)) continue;
        for (int j = 0; j < table.intervals; ++j) {
            LinePart part = rowPart(table, cut, j, column);
            if (anyLane(part.from < part.to)) sum = sum + partTerm(table, cut, i, j, part);
        }
    }
    return sum;
}
#endif

/// The segment against the side x = R: which ends are right of it (0 or 1), where it crosses, and what is left of it.
struct SideCut {
    real right_a, right_b, t_side, t1, t2;
};

EDGEWISE_FN SideCut cutBySide(EDGEWISE_KERNEL_IN Line line) {
    double R = kernel.radius;
    real one = splat(EDGEWISE_REAL(1.0));
    real none = splat(EDGEWISE_REAL(0.0));
    SideCut cut;
    cut.right_a = line.a_x > R ? one : none;
    cut.right_b = line.b_x > R ? one : none;
    // where the line meets x = R, kept within the segment: one point for the term and for the side's share
    real at_side = (R - line.h * line.d_y) * (EDGEWISE_REAL(1.0) / nonZero(line.d_x));
    cut.t_side = smaller(larger(at_side, line.t_a), line.t_b);
    cut.t1 = cut.right_a > EDGEWISE_REAL(0.5) ? cut.t_side : line.t_a;
    cut.t2 = cut.right_b > EDGEWISE_REAL(0.5) ? cut.t_side : line.t_b;
    mask left_part = cut.right_a + cut.right_b < EDGEWISE_REAL(1.5);
    cut.t2 = left_part ? cut.t2 : cut.t1;
    return cut;
}

/// The term whose integral is `sum`.
EDGEWISE_FN EdgeTerm stripTerm(EDGEWISE_KERNEL_IN Line line, SideCut cut, work sum) {
    double R = kernel.radius;
    real one = splat(EDGEWISE_REAL(1.0));
    real none = splat(EDGEWISE_REAL(0.0));
    real right_a = cut.right_a;
    real right_b = cut.right_b;
    real t_side = cut.t_side;
    EdgeTerm term;
    term.value = flushTiny(sum * workOf(line.d_y));
    term.entry = noCrossing();
    term.exit = noCrossing();
    real y = t_side * line.d_y - line.h * line.d_x;
    // a little beyond the corners too, or a vertex there would show some of its crossings and hide the others
    real on_side = absolute(y) < R + EDGEWISE_REAL(1.1641532182693481e-10) ? one : none;
    term.entry.crossed = right_a * (EDGEWISE_REAL(1.0) - right_b) * on_side > EDGEWISE_REAL(0.5);
    term.exit.crossed = right_b * (EDGEWISE_REAL(1.0) - right_a) * on_side > EDGEWISE_REAL(0.5);
    mask crosses = EDGEWISE_EITHER(term.entry.crossed, term.exit.crossed);
    real whole = realOf(term.value);
    term.touched = EDGEWISE_EITHER(EDGEWISE_EITHER(whole < EDGEWISE_REAL(0.0), whole > EDGEWISE_REAL(0.0)), crosses);
    if (!anyLane(crosses)) return term;
    // y errs by 4u R / |d.x|, and no more than the segment is high; [E13]
    real amplified = smaller(EDGEWISE_REAL(1.0) / absolute(nonZero(line.d_x)), splat(EDGEWISE_REAL(134217728.0)));
    term.entry.position = kernelIntegral(kernel.table, workOf(y));
    term.entry.order = y;
    term.entry.doubt = (EDGEWISE_REAL(1.0) + amplified) * R * EDGEWISE_REAL(8.881784197001252e-16);
    term.entry.spread = spreadFrom(line, t_side, line.d_y / nonZero(line.d_x), EDGEWISE_REAL(1.0) - right_a,
                                   EDGEWISE_REAL(1.0) - right_b);
    term.exit.position = term.entry.position;
    term.exit.order = term.entry.order;
    term.exit.doubt = term.entry.doubt;
    term.exit.spread = term.entry.spread;
    return term;
}

EDGEWISE_FN EdgeTerm stripTerms(EDGEWISE_KERNEL_IN Line line) {
    SideCut cut = cutBySide(EDGEWISE_KERNEL line);
    work sum = stripSum(kernel.table, workLineOf(line), workOf(cut.t1), workOf(cut.t2));
    return stripTerm(EDGEWISE_KERNEL line, cut, sum);
}
