// Strip terms of separable kernels: int K(x) k(y) dy along the part of the segment inside the square, and crossings with
// the side x = R. Positions are taken along the line, so that no direction is singular. [E10], [E11], [E13]

EDGEWISE_FN real horner(const double* c, int count, real u) {
    real sum = splat(c[count - 1]);
    for (int i = count - 2; i >= 0; --i) sum = sum * u + c[i];
    return sum;
}

/// K(y), 0 above the square and 1 below.
EDGEWISE_FN real kernelIntegral(const TableView& table, real y) {
    real K = splat(0.0);
    for (int i = 0; i < table.intervals; ++i) {
        const mask here = y >= table.knot[i];
        if (!any(here)) break;
        const real u = (y - table.centre[i]) * table.inverse_half[i];
        K = here ? horner(table.K + i * (table.k_count + 1), table.k_count + 1, u) : K;
    }
    return y < table.knot[table.intervals] ? K : splat(1.0);
}

/// int K(x) k(y) dt over a piece inside cell (i, j).
EDGEWISE_FN real cellTerm(const TableView& table, const Line& line, int i, int j, real t, real step) {
    const double* node = table.rule.node;
    const double* weight = table.rule.weight;
    const int nodes = table.rule.count;
    const int n = table.k_count;
    const real foot_x = line.h * line.d_y, foot_y = -line.h * line.d_x;
    real sum = splat(0.0);
    for (int q = 0; q < nodes; ++q) {
        const real at = t + step * node[q];
        const real u = (foot_x + at * line.d_x - table.centre[i]) * table.inverse_half[i];
        const real v = (foot_y + at * line.d_y - table.centre[j]) * table.inverse_half[j];
        sum = sum + weight[q] * (horner(table.K + i * (n + 1), n + 1, u) * horner(table.k + j * n, n, v));
    }
    return sum * step;
}

/// int K(x) k(y) dt over [t1, t2], cell by cell in a fixed order: a cell that a lane does not meet adds 0 to it.
EDGEWISE_FN real stripSum(const TableView& table, const Line& line, real t1, real t2) {
    const int m = table.intervals;
    const real inverse_x = 1.0 / nonZero(line.d_x), inverse_y = 1.0 / nonZero(line.d_y);
    const real foot_x = line.h * line.d_y, foot_y = -line.h * line.d_x;
    const mask rightwards = nonZero(line.d_x) > 0.0;
    real sum = splat(0.0);
    real x_before = (table.knot[0] - foot_x) * inverse_x;
    for (int i = 0; i < m; ++i) {
        // the last column has no right border: whether the segment leaves there was decided by its ends
        const real border = (table.knot[i + 1] - foot_x) * inverse_x;
        const real x_after = i + 1 < m ? border : (rightwards ? splat(1e300) : splat(-1e300));
        const real low = larger(t1, smaller(x_before, x_after)), high = smaller(t2, larger(x_before, x_after));
        x_before = x_after;
        if (!any(low < high)) continue;
        real y_before = (table.knot[0] - foot_y) * inverse_y;
        for (int j = 0; j < m; ++j) {
            const real y_after = (table.knot[j + 1] - foot_y) * inverse_y;
            const real from = larger(low, smaller(y_before, y_after)), to = smaller(high, larger(y_before, y_after));
            y_before = y_after;
            const mask meets = from < to;
            if (!any(meets)) continue;
            const mask whole = (from == line.t_a) & (to == line.t_b);  // its length is known better than t_b - t_a
            const real here = cellTerm(table, line, i, j, from, whole ? line.length : to - from);
            sum = sum + (meets ? here : splat(0.0));
        }
    }
    return sum;
}

/// Returns the terms before they are rounded to fixed point.
EDGEWISE_FN real stripTerms(const LaneKernel& kernel, const Line& line, int first, EdgeTerms& terms) {
    const TableView& table = kernel.table;
    const double R = kernel.radius;
    const real one = splat(1.0), none = splat(0.0);
    const real right_a = line.a_x > R ? one : none, right_b = line.b_x > R ? one : none;
    // where the line meets x = R, kept within the segment: one point for the term and for the side's share
    const real at_side = (R - line.h * line.d_y) * (1.0 / nonZero(line.d_x));
    const real t_side = smaller(larger(at_side, line.t_a), line.t_b);
    const real t1 = right_a > 0.5 ? t_side : line.t_a;
    const real t2 = right_b > 0.5 ? t_side : line.t_b;
    const mask left_part = right_a + right_b < 1.5;
    const real sum = stripSum(table, line, t1, left_part ? t2 : t1);
    const real value = flushTiny(sum * line.d_y);
    store(toFixed(value), first, terms.value);
    const real y = t_side * line.d_y - line.h * line.d_x;
    // a little beyond the corners too, or a vertex there would show some of its crossings and hide the others
    const real on_side = absolute(y) < R + 0x1p-33 ? one : none;
    const mask entered = right_a * (1.0 - right_b) * on_side > 0.5, left = right_b * (1.0 - right_a) * on_side > 0.5;
    const unsigned entries = laneSet(entered, first), exits = laneSet(left, first);
    terms.touched |= laneSet(value < 0.0 ? one > 0.0 : value > 0.0, first) | entries | exits;
    if (!(entries | exits)) return value;
    const bits position = toFixed(kernelIntegral(table, y));
    // y errs by 4u R / |d.x|, and no more than the segment is high; [E13]
    const real amplified = smaller(1.0 / absolute(nonZero(line.d_x)), splat(0x1p27));
    const real doubt = (1.0 + amplified) * R * 0x1p-50;
    const real spread = spreadFrom(line, t_side, line.d_y / nonZero(line.d_x), 1.0 - right_a, 1.0 - right_b);
    for (int slot = 0; slot < 2; ++slot) {
        terms.crossed[slot] |= slot == 0 ? entries : exits;
        store(position, first, terms.position[slot]);
        store(y, first, terms.order[slot]);
        store(spread, first, terms.spread[slot]);
        store(doubt, first, terms.doubt[slot]);
    }
    return value;
}
