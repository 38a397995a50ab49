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

/// int K(x) k(y) dt over a piece inside cell (i, j).
EDGEWISE_FN work cellTerm(EDGEWISE_IN(TableView) table, EDGEWISE_IN(WorkLine) line, int i, int j, work t, work step) {
    int nodes = table.rule.count;
    int n = table.k_count;
    work sum = splatWork(EDGEWISE_WORK(0.0));
    for (int q = 0; q < nodes; ++q) {
        work at = t + step * EDGEWISE_AT(table.rule.node, q);
        work u = (line.foot_x + at * line.d_x - EDGEWISE_AT(table.centre, i)) * EDGEWISE_AT(table.inverse_half, i);
        work v = (line.foot_y + at * line.d_y - EDGEWISE_AT(table.centre, j)) * EDGEWISE_AT(table.inverse_half, j);
        sum = sum + EDGEWISE_AT(table.rule.weight, q) * (horner(table.K + i * (n + 1), n + 1, u) * horner(table.k + j * n, n, v));
    }
    return sum * step;
}

/// int K(x) k(y) dt over [t1, t2], cell by cell in a fixed order: a cell that a lane does not meet adds 0 to it.
EDGEWISE_FN work stripSum(EDGEWISE_IN(TableView) table, EDGEWISE_IN(WorkLine) line, work t1, work t2) {
    int m = table.intervals;
    work inverse_x = EDGEWISE_WORK(1.0) / nonZeroWork(line.d_x);
    work inverse_y = EDGEWISE_WORK(1.0) / nonZeroWork(line.d_y);
    work far = splatWork(kFar);
    work_mask rightwards = nonZeroWork(line.d_x) > EDGEWISE_WORK(0.0);
    work sum = splatWork(EDGEWISE_WORK(0.0));
    work x_before = (EDGEWISE_AT(table.knot, 0) - line.foot_x) * inverse_x;
    for (int i = 0; i < m; ++i) {
        // the last column has no right border: whether the segment leaves there was decided by its ends
        work border = (EDGEWISE_AT(table.knot, i + 1) - line.foot_x) * inverse_x;
        work x_after = i + 1 < m ? border : (rightwards ? far : -far);
        work low = larger(t1, smaller(x_before, x_after));
        work high = smaller(t2, larger(x_before, x_after));
        x_before = x_after;
        if (!anyLane(low < high)) continue;
        work y_before = (EDGEWISE_AT(table.knot, 0) - line.foot_y) * inverse_y;
        for (int j = 0; j < m; ++j) {
            work y_after = (EDGEWISE_AT(table.knot, j + 1) - line.foot_y) * inverse_y;
            work from = larger(low, smaller(y_before, y_after));
            work to = smaller(high, larger(y_before, y_after));
            y_before = y_after;
            work_mask meets = from < to;
            if (!anyLane(meets)) continue;
            work_mask whole = EDGEWISE_BOTH(from == line.t_a, to == line.t_b);  // its length is known better than t_b - t_a
            work here = cellTerm(table, line, i, j, from, whole ? line.len : to - from);
            sum = sum + (meets ? here : splatWork(EDGEWISE_WORK(0.0)));
        }
    }
    return sum;
}

EDGEWISE_FN EdgeTerm stripTerms(EDGEWISE_KERNEL_IN Line line) {
    double R = kernel.radius;
    real one = splat(EDGEWISE_REAL(1.0));
    real none = splat(EDGEWISE_REAL(0.0));
    real right_a = line.a_x > R ? one : none;
    real right_b = line.b_x > R ? one : none;
    // where the line meets x = R, kept within the segment: one point for the term and for the side's share
    real at_side = (R - line.h * line.d_y) * (EDGEWISE_REAL(1.0) / nonZero(line.d_x));
    real t_side = smaller(larger(at_side, line.t_a), line.t_b);
    real t1 = right_a > EDGEWISE_REAL(0.5) ? t_side : line.t_a;
    real t2 = right_b > EDGEWISE_REAL(0.5) ? t_side : line.t_b;
    mask left_part = right_a + right_b < EDGEWISE_REAL(1.5);
    WorkLine work_line = workLineOf(line);
    work sum = stripSum(kernel.table, work_line, workOf(t1), workOf(left_part ? t2 : t1));
    EdgeTerm term;
    term.value = flushTiny(sum * work_line.d_y);
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
