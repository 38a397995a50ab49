// edgeTerms() for one instruction set: define EDGEWISE_ISA (a namespace) and EDGEWISE_LANES (1, 2, 4 or 8), and
// EDGEWISE_FP32 for float terms, then include. Nothing here may call an inline function of another namespace: it could
// be linked into code for an older machine.
#include "analytic/lane_kernel.h"
#include "analytic/shared_text.h"

#if defined(__x86_64__) && EDGEWISE_LANES > 1 && !defined(EDGEWISE_X86)
#include <immintrin.h>
#define EDGEWISE_X86
#endif

namespace edgewise::EDGEWISE_ISA {
namespace {
#include "analytic/real_lanes.h"
#include "shaders/shared/double_double.glsl"
#include "shaders/shared/transcendental.glsl"
#ifdef EDGEWISE_FP32
#include "shaders/shared/transcendental_float.glsl"
#endif
#include "shaders/shared/fan_terms.glsl"

/// EdgeInput, for each lane its own.
struct SeenEdge {
    real a_x, a_y, a_rest_x, a_rest_y, b_x, b_y, b_rest_x, b_rest_y, len;
    real origin_x, origin_y, nx_hi, nx_lo, ny_hi, ny_lo, c_hi, c_lo, line_length, direction_x, direction_y;
};

#include "shaders/shared/edge_line.glsl"
#include "shaders/shared/edge_work.glsl"
#include "shaders/shared/edge_fan.glsl"
#include "shaders/shared/edge_strip.glsl"

/// number(0), number(1), ... by lane.
template <class Number>
EDGEWISE_FN real gathered(const Number& number) {
#if EDGEWISE_LANES == 1
    return number(0);
#elif EDGEWISE_LANES == 2
    return real{number(0), number(1)};
#elif EDGEWISE_LANES == 4
    return real{number(0), number(1), number(2), number(3)};
#else
    return real{number(0), number(1), number(2), number(3), number(4), number(5), number(6), number(7)};
#endif
}

template <class Vector, class Number>
EDGEWISE_FN void scatter(Vector value, const int* place, int count, Number* out) {
    Number lane[EDGEWISE_LANES];
    __builtin_memcpy(lane, &value, sizeof value);
    for (int i = 0; i < EDGEWISE_LANES; ++i)
        if (i < count) out[place[i]] = lane[i];
}

EDGEWISE_FN void store(bits value, int first, std::int64_t* out) { __builtin_memcpy(out + first, &value, sizeof value); }
EDGEWISE_FN void store(real value, int first, double* out) { __builtin_memcpy(out + first, &value, sizeof value); }

/// The lines of pairs [0, EDGEWISE_LANES).
EDGEWISE_FN Line lineOf(const EdgePair* pairs) {
    const auto of = [=](auto member) __attribute__((always_inline)) {
        return gathered([=](int i) __attribute__((always_inline)) { return pairs[i].edge->*member; });
    };
    SeenEdge seen;
    seen.a_x = of(&EdgeInput::a_x), seen.a_y = of(&EdgeInput::a_y);
    seen.a_rest_x = of(&EdgeInput::a_rest_x), seen.a_rest_y = of(&EdgeInput::a_rest_y);
    seen.b_x = of(&EdgeInput::b_x), seen.b_y = of(&EdgeInput::b_y);
    seen.b_rest_x = of(&EdgeInput::b_rest_x), seen.b_rest_y = of(&EdgeInput::b_rest_y);
    seen.len = of(&EdgeInput::len);
    seen.origin_x = of(&EdgeInput::origin_x), seen.origin_y = of(&EdgeInput::origin_y);
    seen.nx_hi = of(&EdgeInput::nx_hi), seen.nx_lo = of(&EdgeInput::nx_lo);
    seen.ny_hi = of(&EdgeInput::ny_hi), seen.ny_lo = of(&EdgeInput::ny_lo);
    seen.c_hi = of(&EdgeInput::c_hi), seen.c_lo = of(&EdgeInput::c_lo);
    seen.line_length = of(&EdgeInput::line_length);
    seen.direction_x = of(&EdgeInput::direction_x), seen.direction_y = of(&EdgeInput::direction_y);
    return lineAt(seen, gathered([=](int i) __attribute__((always_inline)) { return pairs[i].sample_x; }),
                  gathered([=](int i) __attribute__((always_inline)) { return pairs[i].sample_y; }));
}

EDGEWISE_FN void storeCrossing(const BorderPoint& point, int slot, int first, EdgeTerms& terms) {
    const PairSet crossed = PairSet{laneSet(point.crossed)} << first;
    terms.crossed[slot] |= crossed;
    if (!crossed) return;
    store(toFixed(realOf(point.position)), first, terms.position[slot]);
    store(point.order, first, terms.order[slot]);
    store(point.doubt, first, terms.doubt[slot]);
    store(point.spread, first, terms.spread[slot]);
}

EDGEWISE_FN void storeTerm(const EdgeTerm& term, int first, EdgeTerms& terms) {
    terms.touched |= PairSet{laneSet(term.touched)} << first;
    const real value = realOf(term.value);
    store(toFixed(term.touched ? value : splat(0.0)), first, terms.value);
    storeCrossing(term.entry, 0, first, terms);
    storeCrossing(term.exit, 1, first, terms);
}

/// Without what fills the last vector up.
EDGEWISE_FN void keepFirst(int count, EdgeTerms& terms) {
    const PairSet wanted = ~PairSet{0} >> (kMostPairs - count);
    terms.touched &= wanted, terms.crossed[0] &= wanted, terms.crossed[1] &= wanted;
}

/// The box: one cell, one node. What is constant there need not be asked in every term.
EDGEWISE_FN void boxTermsOf(const LaneKernel& kernel, const EdgePair* pairs, int count, EdgeTerms& terms) {
    LaneKernel box = kernel;
    box.table.intervals = box.table.k_count = box.table.rule.count = 1;
    for (int first = 0; first < count; first += EDGEWISE_LANES)
        storeTerm(stripTerms(box, lineOf(pairs + first)), first, terms);
}

/// A list of pairs, filled up to whole vectors.
struct PairList {
    int at[kMostPairs + EDGEWISE_LANES];
    int count = 0;

    EDGEWISE_FN void add(PairSet set) {
        for (; set != 0; set &= set - 1) at[count++] = __builtin_ctzll(set);
    }
    EDGEWISE_FN void fill() {
        for (int i = 0; i < EDGEWISE_LANES && count > 0; ++i) at[count + i] = at[count - 1];
    }
    EDGEWISE_FN int lanesFrom(int first) const {
        return count - first < EDGEWISE_LANES ? count - first : EDGEWISE_LANES;
    }
};

EDGEWISE_FN real pick(const double* numbers, const int* at) {
    return gathered([=](int i) __attribute__((always_inline)) { return numbers[at[i]]; });
}

#ifdef EDGEWISE_FP32
EDGEWISE_FN void store(work value, int first, float* out) { __builtin_memcpy(out + first, &value, sizeof value); }
#endif
EDGEWISE_FN work workAt(const work_number* numbers, int first) {
    work value;
    __builtin_memcpy(&value, numbers + first, sizeof value);
    return value;
}

/// Lines cut by the side, in the precision of the terms, and the sum of each over the cells so far.
struct StripPairs {
    Line line[kMostPairs / EDGEWISE_LANES];
    SideCut side[kMostPairs / EDGEWISE_LANES];
    alignas(64) work_number foot_x[kMostPairs], foot_y[kMostPairs], d_x[kMostPairs], d_y[kMostPairs];
    alignas(64) work_number t_a[kMostPairs], t_b[kMostPairs], len[kMostPairs];
    alignas(64) work_number inverse_x[kMostPairs], inverse_y[kMostPairs], from[kMostPairs], to[kMostPairs];
    alignas(64) work_number sum[kMostPairs];
};

EDGEWISE_FN void cutStrips(const LaneKernel& kernel, const EdgePair* pairs, int count, StripPairs& strips) {
    for (int first = 0; first < count; first += EDGEWISE_LANES) {
        const Line line = lineOf(pairs + first);
        const SideCut side = cutBySide(kernel, line);
        const CutLine cut = cutLineOf(workLineOf(line), workOf(side.t1), workOf(side.t2));
        strips.line[first / EDGEWISE_LANES] = line, strips.side[first / EDGEWISE_LANES] = side;
        store(cut.line.foot_x, first, strips.foot_x), store(cut.line.foot_y, first, strips.foot_y);
        store(cut.line.d_x, first, strips.d_x), store(cut.line.d_y, first, strips.d_y);
        store(cut.line.t_a, first, strips.t_a), store(cut.line.t_b, first, strips.t_b);
        store(cut.line.len, first, strips.len);
        store(cut.inverse_x, first, strips.inverse_x), store(cut.inverse_y, first, strips.inverse_y);
        store(cut.whole.from, first, strips.from), store(cut.whole.to, first, strips.to);
        store(splatWork(0), first, strips.sum);
    }
}

/// number(k) of each lane's pair makes the cut line.
template <class Numbers>
EDGEWISE_FN CutLine cutLineFrom(const StripPairs& strips, const Numbers& numbers) {
    CutLine cut;
    cut.line.foot_x = numbers(strips.foot_x), cut.line.foot_y = numbers(strips.foot_y);
    cut.line.d_x = numbers(strips.d_x), cut.line.d_y = numbers(strips.d_y);
    cut.line.t_a = numbers(strips.t_a), cut.line.t_b = numbers(strips.t_b), cut.line.len = numbers(strips.len);
    cut.inverse_x = numbers(strips.inverse_x), cut.inverse_y = numbers(strips.inverse_y);
    cut.rightwards = nonZeroWork(cut.line.d_x) > numberOf(0.0);
    cut.whole.from = numbers(strips.from), cut.whole.to = numbers(strips.to);
    return cut;
}

EDGEWISE_FN work pickWork(const work_number* numbers, const int* at) {
    work_number picked[EDGEWISE_LANES];
    for (int i = 0; i < EDGEWISE_LANES; ++i) picked[i] = numbers[at[i]];
    return workAt(picked, 0);
}

EDGEWISE_FN PairSet laneSetOf(work_mask m) {
#if defined(EDGEWISE_FP32) && EDGEWISE_LANES > 1
    return laneSet(__builtin_convertvector(m, mask));
#else
    return laneSet(m);
#endif
}

/// A cell's terms of the pairs that meet it, side by side.
EDGEWISE_FN void addCell(const TableView& table, int i, int j, PairSet met, StripPairs& strips) {
    PairList list;
    list.add(met);
    list.fill();
    for (int first = 0; first < list.count; first += EDGEWISE_LANES) {
        const int* at = list.at + first;
        const CutLine cut = cutLineFrom(
            strips, [=](const work_number* numbers) __attribute__((always_inline)) { return pickWork(numbers, at); });
        const LinePart part = rowPart(table, cut, j, columnPart(table, cut, i));
        scatter(pickWork(strips.sum, at) + partTerm(table, cut, i, j, part), at, list.lanesFrom(first), strips.sum);
    }
}

/// Cells (i, j0) to (i, j1) of stripSum(), for all pairs; no more than kMostIntervals.
EDGEWISE_FN void sumColumn(const TableView& table, int i, int j0, int j1, int count, StripPairs& strips) {
    PairSet met[kMostIntervals] = {};
    for (int first = 0; first < count; first += EDGEWISE_LANES) {
        const CutLine cut = cutLineFrom(
            strips, [=](const work_number* numbers) __attribute__((always_inline)) { return workAt(numbers, first); });
        const LinePart column = columnPart(table, cut, i);
        if (!anyLane(column.from < column.to)) continue;
        for (int j = j0; j < j1; ++j) {
            const LinePart part = rowPart(table, cut, j, column);
            met[j - j0] |= laneSetOf(part.from < part.to) << first;
        }
    }
    for (int j = j0; j < j1; ++j)
        if (met[j - j0] != 0) addCell(table, i, j, met[j - j0] & ~PairSet{0} >> (kMostPairs - count), strips);
}

/// stripSum() of all pairs, cell by cell in the same order.
EDGEWISE_FN void sumCells(const TableView& table, int count, StripPairs& strips) {
    for (int i = 0; i < table.intervals; ++i)
        for (int j = 0; j < table.intervals; j += kMostIntervals)
            sumColumn(table, i, j, j + kMostIntervals < table.intervals ? j + kMostIntervals : table.intervals, count,
                      strips);
}

EDGEWISE_FN void stripTermsOf(const LaneKernel& kernel, const EdgePair* pairs, int count, EdgeTerms& terms) {
    StripPairs strips;
    cutStrips(kernel, pairs, count, strips);
    sumCells(kernel.table, count, strips);
    for (int first = 0; first < count; first += EDGEWISE_LANES) {
        const int at = first / EDGEWISE_LANES;
        storeTerm(stripTerm(kernel, strips.line[at], strips.side[at], workAt(strips.sum, first)), first, terms);
    }
}

/// What is left to do for fan terms once lines are cut: by pair, then for those alone that need it.
struct CutPairs {
    alignas(64) double h[kMostPairs], d_x[kMostPairs], d_y[kMostPairs], t_a[kMostPairs], t_b[kMostPairs];
    alignas(64) double t1[kMostPairs], t2[kMostPairs], len[kMostPairs];
    alignas(64) double place[2][kMostPairs];  ///< t of the entry and the exit
    alignas(64) double in_a[kMostPairs], in_b[kMostPairs];
};

EDGEWISE_FN void cutPairs(const LaneKernel& kernel, const EdgePair* pairs, int count, CutPairs& cuts, EdgeTerms& terms) {
    for (int first = 0; first < count; first += EDGEWISE_LANES) {
        const Line line = lineOf(pairs + first);
        const DiskCut cut = cutByDisk(kernel, line);
        terms.touched |= PairSet{laneSet(cut.touched)} << first;
        terms.crossed[0] |= PairSet{laneSet(entersDisk(cut))} << first;
        terms.crossed[1] |= PairSet{laneSet(leavesDisk(cut))} << first;
        store(line.h, first, cuts.h), store(line.d_x, first, cuts.d_x), store(line.d_y, first, cuts.d_y);
        store(line.t_a, first, cuts.t_a), store(line.t_b, first, cuts.t_b);
        store(cut.t1, first, cuts.t1), store(cut.t2, first, cuts.t2), store(cut.len, first, cuts.len);
        store(cut.entry, first, cuts.place[0]), store(cut.exit, first, cuts.place[1]);
        store(cut.in_a, first, cuts.in_a), store(cut.in_b, first, cuts.in_b);
    }
}

/// Crossings of slot 0 or 1: those alone, side by side.
EDGEWISE_FN void circleCrossings(const LaneKernel& kernel, const CutPairs& cuts, int slot, EdgeTerms& terms) {
    PairList list;
    list.add(terms.crossed[slot]);
    list.fill();
    for (int first = 0; first < list.count; first += EDGEWISE_LANES) {
        const int* at = list.at + first;
        Line line{};
        line.h = pick(cuts.h, at), line.d_x = pick(cuts.d_x, at), line.d_y = pick(cuts.d_y, at);
        line.t_a = pick(cuts.t_a, at), line.t_b = pick(cuts.t_b, at);
        const real one = splat(1.0), exits = splat(slot);
        const BorderPoint point = circleCrossing(kernel, line, pick(cuts.place[slot], at), pick(cuts.in_a, at),
                                                 pick(cuts.in_b, at), one > 0.0, exits > 0.5);
        const int lanes = list.lanesFrom(first);
        scatter(toFixed(realOf(point.position)), at, lanes, terms.position[slot]);
        scatter(point.order, at, lanes, terms.order[slot]);
        scatter(point.doubt, at, lanes, terms.doubt[slot]);
        scatter(point.spread, at, lanes, terms.spread[slot]);
    }
}

/// Values of the touched pairs. A Gaussian's pieces of like length take like rules: they are put side by side.
EDGEWISE_FN void fanValues(const LaneKernel& kernel, const CutPairs& cuts, EdgeTerms& terms) {
    PairSet longer[kPieceRules] = {terms.touched, 0, 0};  // than rule k is for
    if (kernel.form == kGaussianTerm)
        for (int k = 1; k < kPieceRules; ++k)
            for (PairSet set = longer[k - 1]; set != 0; set &= set - 1) {
                const int pair = __builtin_ctzll(set);
                if (cuts.len[pair] > kernel.piece_rules[k - 1].limit_sigma * kernel.sigma) longer[k] |= PairSet{1} << pair;
            }
    PairList list;
    list.add(longer[0] & ~longer[1]);
    list.add(longer[1] & ~longer[2]);
    list.add(longer[2]);
    list.fill();
    for (int first = 0; first < list.count; first += EDGEWISE_LANES) {
        const int* at = list.at + first;
        Piece piece;
        piece.t1 = workOf(pick(cuts.t1, at)), piece.t2 = workOf(pick(cuts.t2, at));
        piece.len = workOf(pick(cuts.len, at));
        const work value = flushTiny(fanTerm(kernel, workOf(pick(cuts.h, at)), piece));
        scatter(toFixed(realOf(value)), at, list.lanesFrom(first), terms.value);
    }
}

EDGEWISE_FN void fanTermsOf(const LaneKernel& kernel, const EdgePair* pairs, int count, EdgeTerms& terms) {
    CutPairs cuts;
    cutPairs(kernel, pairs, count, cuts, terms);
    keepFirst(count, terms);
    fanValues(kernel, cuts, terms);
    circleCrossings(kernel, cuts, 0, terms);
    circleCrossings(kernel, cuts, 1, terms);
}
}  // namespace

void edgeTerms(const LaneKernel& kernel, const EdgePair* pairs, int count, EdgeTerms& terms);
void edgeTerms(const LaneKernel& kernel, const EdgePair* given, int count, EdgeTerms& terms) {
    EdgePair pairs[kMostPairs + EDGEWISE_LANES];
    for (int i = 0; i < count; ++i) pairs[i] = given[i], terms.value[i] = 0;
    for (int i = 0; i < EDGEWISE_LANES; ++i) pairs[count + i] = given[count - 1];
    terms.touched = terms.crossed[0] = terms.crossed[1] = 0;
    const TableView& table = kernel.table;
    if (kernel.form != kStripTerm)
        fanTermsOf(kernel, pairs, count, terms);
    else if (table.intervals == 1 && table.k_count == 1 && table.rule.count == 1)
        boxTermsOf(kernel, pairs, count, terms);
    else
        stripTermsOf(kernel, pairs, count, terms);
    keepFirst(count, terms);
}

}  // namespace edgewise::EDGEWISE_ISA
