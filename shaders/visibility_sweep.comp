#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// The owners of a leaf, slab by slab: analytic/slab_sweep.cpp. A dispatch sweeps as many slabs as the budget of loops
// allows; what a leaf knows stays in its buffers until the next. While it is swept that lies in arrays of the
// invocation's own, and what few lines need is done in loops of its own over those lines: invocations that run together
// all go where one of them goes.
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const bool kExact = false;  // comparisons that the filter leaves open are decided
#include "shared/visibility_buffers.glsl"
#include "shared/visibility_int64.glsl"
#include "shared/line_key.glsl"
#include "shared/visibility_leaf.glsl"
#include "shared/exact_sign.glsl"

// Beyond the budget of loops a leaf waits for the next dispatch; a slab takes some hundreds. A leaf that needs exact
// comparisons runs alone.
const uint kExactLoops = 400u;  // of one comparison

const uint kBorderLine = 0xffffffffu;  // in the place of a line: the cell's border
// Two abscissae nearer than this may stand in any order: each carries 5 roundings of at most 2^-49 px.
const double kUnsure = 1.7763568394002505e-14lf;
// Canonical points are rounded to multiples of 2^-76 px: each of one line's two ends may be off by one of them.
const double kSame = 2.6469779601696886e-23lf;

bool undecided = false;
uint mask_bits;
double y_mid;
FineCoordinate top_y, bottom_y;
OrderKey top_key, bottom_key;
uint below_first, below_count;
bool same_profiles;

// By line.
uint spans[kLeafLines], bounds[kLeafLines];
double enter_x[kLeafLines], exit_x[kLeafLines], enter_grid[kLeafLines], enter_rest[kLeafLines], slopes[kLeafLines];
double x_ends[kLeafLines], x_middles[kLeafLines];  // at the slab's bottom, or at its top until the line is placed; at its middle
uint noted[2u * kLeafLines];                       // 256 key + event, by the key's parity: the newest of a line
uint left_owner[kLeafLines], right_owner[kLeafLines], new_left[kLeafLines], new_right[kLeafLines];
uint64_t left_lines, open_lines, labelled, relabelled;
// By place from left to right.
uint order[kLeafLines], arrived[kLeafLines], chosen_at[kLeafLines];
double x_order[kLeafLines];
uint64_t joined;  // places whose line runs on that of the place before
bool unsure;
uint entry_line[kLeafLines];
uint profile_line[2u * kLeafLines], profile_owner[2u * kLeafLines];  // by the slab's parity
LocalPlane local_plane[kLeafTriangles];

uint64_t bitOf(uint i) { return uint64_t(1u) << i; }
bool holds(uint64_t bits, uint i) { return (bits >> i & uint64_t(1u)) != uint64_t(0u); }
uint lowest(uint64_t bits) {
    uvec2 halves = unpackUint2x32(bits);
    return uint(halves.x != 0u ? findLSB(halves.x) : 32 + findLSB(halves.y));
}

FineCoordinate ordinateOf(GpuKey key) { return FineCoordinate(key.y[0], key.y[1]); }
double localY(FineCoordinate y) { return (y.grid - frame.origin.y) + y.rest; }
uint profileAt(uint slab) { return (slab & 1u) * kLeafLines; }
uint notedAt(uint key, uint i) { return (key & 1u) * kLeafLines + i; }

// The keys where a line begins on the left or right, enters, exits, and ends: a byte each.
uint beginOf(uint span) { return span & 255u; }
uint enterOf(uint span) { return span >> 8 & 255u; }
uint exitOf(uint span) { return span >> 16 & 255u; }
uint endOf(uint span) { return span >> 24; }

double xAt(uint i, FineCoordinate y) {
    double dy = (y.grid - enter_grid[i]) + (y.rest - enter_rest[i]);
    return enter_x[i] + dy * slopes[i];
}

/// The canonical point of a line at a key: where it enters or exits, where an event gave it, or computed.
FinePoint pointAt(uint i, uint key, FineCoordinate y, bool enters) {
    uint note = noted[notedAt(key, i)];
    FinePoint point = pointAtY(carrierFrom(lines[lineAt(i)]), y);
    if (note >> 8 == key) point = pointFrom(events[eventAt(note & 255u)].point);
    if (enters && enterOf(spans[i]) == key) point = pointFrom(lines[lineAt(i)].enter);
    if (exitOf(spans[i]) == key) point = pointFrom(lines[lineAt(i)].exit);
    return point;
}
FinePoint topPoint(uint i) { return pointAt(i, leaf.slab, top_y, true); }
FinePoint bottomPoint(uint i) { return pointAt(i, leaf.slab + 1u, bottom_y, false); }

void emit(uvec2 key, LineRef line, uint left, uint right, FinePoint a, FinePoint b) {
    if (left == right) return;
    uint at = atomicAdd(status.pieces, 1u);
    if (at < status.pieces_room)
        pieces[at] = GpuPiece(pointTo(a), pointTo(b), key.x, key.y, line.i, line.j, left, right,
                              push.first + leaf_slot, 0u);
}

void closePiece(uint i, FinePoint end) {
    GpuLine line = lines[lineAt(i)];
    FinePoint start = pointFrom(tracks[lineAt(i)].start);
    double dx = difference(xOf(end), xOf(start)), dy = difference(yOf(end), yOf(start));
    bool along = dx * line.slope + dy >= 0.0lf;
    uint left = left_owner[i], right = right_owner[i];
    emit(uvec2(line.key_low, line.key_high), LineRef(line.line_i, line.line_j), along ? left : right,
         along ? right : left, along ? start : end, along ? end : start);
}

void noteEvent(uint i, uint key, uint event) {
    if (noted[notedAt(key, i)] >> 8 == key) return;
    noted[notedAt(key, i)] = 256u * key + event;
    x_middles[i] = localX(frame, pointFrom(events[eventAt(event)].point));
}

void noteEvents(uint key) {
    for (; leaf.next_event < leaf.events; ++leaf.next_event, ++spent) {
        uint e = leaf.next_event;
        if (events[eventAt(e)].slab > key) break;
        if (events[eventAt(e)].slab < key) continue;
        noteEvent(events[eventAt(e)].p, key, e);
        noteEvent(events[eventAt(e)].q, key, e);
    }
}

/// A line takes its place among those left of it; they were nearly sorted in the slab above.
void place(uint i, uint count) {
    double x = x_middles[i];
    uint j = count;
    for (; j > 0u; --j, ++spent) {
        double d = x_order[j - 1u] - x;
        unsure = unsure || abs(d) <= kUnsure;
        if (d <= 0.0lf) break;
        x_order[j] = x_order[j - 1u];
        order[j] = order[j - 1u];
    }
    x_order[j] = x;
    order[j] = i;
}

/// Lines end, carry on from the slab above, or begin; then the order at the slab's middle.
void locate(uint slab) {
    noteEvents(slab + 1u);
    uint count = 0u;
    for (uint k = 0u; k < leaf.order; ++k, ++spent) {
        arrived[count] = order[k];
        if (exitOf(spans[order[k]]) != slab) ++count;
    }
    while (leaf.next_entry < leaf.entries && enterOf(spans[entry_line[leaf.next_entry]]) <= slab) {
        arrived[count++] = entry_line[leaf.next_entry++];
        ++spent;
    }
    unsure = false;
    joined = uint64_t(0u);
    leaf.order = count;
    for (uint k = 0u; k < count; ++k, spent += 2u) {
        uint i = arrived[k];
        double x_top = enterOf(spans[i]) == slab ? enter_x[i] : x_ends[i], x_bottom = xAt(i, bottom_y);
        if (noted[notedAt(slab + 1u, i)] >> 8 == slab + 1u) x_bottom = x_middles[i];
        if (exitOf(spans[i]) == slab + 1u) x_bottom = exit_x[i];
        x_ends[i] = x_bottom;
        x_middles[i] = 0.5lf * (x_top + x_bottom);
        place(i, k);
    }
}

/// -1, 0 or 1 as line p runs left of, on or right of line q in the slab.
int compare(uint p, uint q) {
    double d = x_middles[p] - x_middles[q];
    GpuTrack s = tracks[lineAt(p)], t = tracks[lineAt(q)];
    double fine = ((s.grid[0] - t.grid[0]) + (s.grid[1] - t.grid[1])) + ((s.rest[0] - t.rest[0]) + (s.rest[1] - t.rest[1]));
    if (abs(d) > kUnsure) return d > 0.0lf ? 1 : -1;
    return abs(fine) <= kSame ? 0 : (fine > 0.0lf ? 1 : -1);
}

/// The order again, by canonical points where doubles leave it open; which places hold one line's, and which of their
/// lines is labelled.
void locateFinely() {
    uint count = unsure ? leaf.order : 0u;
    for (uint k = 0u; k < count; ++k, ++spent) {
        uint i = arrived[k];
        FinePoint top = topPoint(i), bottom = bottomPoint(i);
        tracks[lineAt(i)].grid = double[2](top.grid.x, bottom.grid.x);
        tracks[lineAt(i)].rest = double[2](top.rest.x, bottom.rest.x);
    }
    for (uint k = 0u; k < count; ++k, spent += 2u) {
        uint i = arrived[k], j = k;
        for (; j > 0u && compare(order[j - 1u], i) > 0; --j, ++spent) order[j] = order[j - 1u];
        order[j] = i;
    }
    uint first = 0u;
    for (uint k = 0u; k < count; ++k, ++spent) {
        uint i = order[k], chosen = i;
        x_order[k] = x_middles[i];
        if (k > 0u && compare(i, first) == 0) {
            uint best_line = chosen_at[k - 1u];
            LineRef ref = LineRef(lines[lineAt(i)].line_i, lines[lineAt(i)].line_j);
            LineRef best = LineRef(lines[lineAt(best_line)].line_i, lines[lineAt(best_line)].line_j);
            bool ref_edge = ref.j >= kFirstEdge, best_edge = best.j >= kFirstEdge;
            chosen = (ref_edge != best_edge ? ref_edge : refBefore(ref, best)) ? i : best_line;
            joined |= bitOf(k);
        } else {
            first = i;
        }
        chosen_at[k] = chosen;
    }
}

/// Half the sum of a line's abscissae at the slab's ends, or of a border's, from the anchor.
dd exactMiddle(uint line, double border_grid) {
    if (line == kBorderLine) return offsetFrom(border(border_grid), push.anchor_x);
    dd sum = ddAdd(offsetFrom(xOf(topPoint(line)), push.anchor_x), offsetFrom(xOf(bottomPoint(line)), push.anchor_x));
    return dd(0.5lf * sum.hi, 0.5lf * sum.lo);
}

/// Decided at the canonical middle, which knows nothing of the cell's frame.
bool exactlyInFront(LocalPlane p, LocalPlane q, uint left, uint right) {
    if (!kExact || spent + kExactLoops > 2u * loopBudget()) {
        undecided = true;
        return false;
    }
    ++leaf.compared_exactly;
    spent += kExactLoops;
    dd x = ddAdd(exactMiddle(left == kBorderLine ? left : order[left], frame.cell.min.x), exactMiddle(right == kBorderLine ? right : order[right], frame.cell.max.x));
    dd y = ddAdd(offsetFrom(top_y, push.anchor_y), offsetFrom(bottom_y, push.anchor_y));
    int sign = depthDifferenceSign(planeAt(p.plane), planeAt(q.plane), dd(0.5lf * x.hi, 0.5lf * x.lo),
                                   dd(0.5lf * y.hi, 0.5lf * y.lo));
    return sign != 0 ? sign > 0 : p.owner < q.owner;
}

/// The owner seen between the lines of two places, or the cell's borders.
uint seen(uint left, uint right) {
    double x0 = left == kBorderLine ? (frame.cell.min.x - frame.origin.x) + border(0.0lf).rest : x_order[left];
    double x1 = right == kBorderLine ? (frame.cell.max.x - frame.origin.x) + border(0.0lf).rest : x_order[right];
    double x = 0.5lf * (x0 + x1);
    bool any_seen = false;
    LocalPlane best = LocalPlane(0.0lf, 0.0lf, 0.0lf, 0.0lf, 0u, kBackground);
    for (uint bits = mask_bits; bits != 0u; bits &= bits - 1u, spent += kExact ? 8u : 1u) {
        LocalPlane p = local_plane[findLSB(bits)];
        bool nearer = true;
        if (any_seen) {
            int order_now = filteredOrder(p, best, x, y_mid);
            nearer = order_now > 0;
            if (order_now == 0) nearer = exactlyInFront(p, best, left, right);
        }
        if (nearer) best = p;
        any_seen = true;
    }
    return best.owner;
}

/// What covers the slab's left end.
void startMask(uint slab) {
    mask_bits = 0u;
    for (uint64_t bits = left_lines; bits != uint64_t(0u); bits &= bits - uint64_t(1u), ++spent) {
        uint i = lowest(bits), span = spans[i];
        bool before = beginOf(span) <= slab && slab < enterOf(span), after = exitOf(span) <= slab && slab < endOf(span);
        if (before || after) mask_bits ^= bounds[i];
    }
}

void addBound(uint slab, uint line, uint before, uint after) {
    uint at = profileAt(slab) + below_count, above = profileAt(slab + 1u) + below_count;
    same_profiles = same_profiles && below_count < leaf.above_count && profile_line[above] == line && profile_owner[above] == after;
    profile_line[at] = line;
    profile_owner[at] = after;
    ++below_count;
    bool same = holds(open_lines, line) && left_owner[line] == before && right_owner[line] == after;
    if (!same) relabelled |= bitOf(line);
    labelled |= bitOf(line);
    new_left[line] = before;
    new_right[line] = after;
}

/// Walks the slab's middle from left to right; labels the lines where the owner changes.
void sweep(uint slab) {
    startMask(slab);
    y_mid = 0.5lf * (localY(top_y) + localY(bottom_y));
    labelled = relabelled = uint64_t(0u);
    below_count = 0u;
    uint owner = 0u, first = kBorderLine;
    // The first turn asks what is seen at the left border, each other one passes a line.
    for (uint turn = 0u; turn <= leaf.order; ++turn, spent += 2u) {
        uint k = turn - 1u;
        if (turn > 0u) {
            mask_bits ^= bounds[order[k]];
            if (!holds(joined, k)) first = k;
        }
        bool more = turn < leaf.order && holds(joined, turn);
        if (more) continue;
        uint after = seen(first, turn < leaf.order ? turn : kBorderLine);
        if (turn == 0u) {
            below_first = owner = after;
            same_profiles = below_first == leaf.above_first;
            continue;
        }
        if (after == owner) continue;
        addBound(slab, unsure ? chosen_at[k] : order[k], owner, after);
        owner = after;
    }
    same_profiles = same_profiles && below_count == leaf.above_count;
}

/// Pieces end where lines end or their owners change, and begin with their new owners.
void updatePieces() {
    uint64_t changed = (open_lines & ~labelled) | relabelled;
    for (uint64_t bits = changed; bits != uint64_t(0u); bits &= bits - uint64_t(1u), ++spent) {
        uint i = lowest(bits);
        FinePoint top = topPoint(i);
        if (holds(open_lines, i)) closePiece(i, top);
        if (!holds(labelled, i)) continue;
        left_owner[i] = new_left[i];
        right_owner[i] = new_right[i];
        tracks[lineAt(i)].start = pointTo(top);
    }
    open_lines = labelled;
}

void emitRows(uint slab) {
    for (int row = int(floor(top_y.grid - 0.5lf)); double(row) + 0.5lf <= bottom_y.grid; ++row, spent += 2u) {
        FineCoordinate y = sampleRow(row);
        OrderKey key = orderKey(y, frame.origin.y);
        if (keyLess(key, top_key) || !keyLess(key, bottom_key)) continue;
        uint tag = push.first + leaf_slot, at = atomicAdd(status.rows, 1u + below_count);
        double reached = frame.cell.min.x + border(0.0lf).rest;  // rounding must not exchange the ends of a thin owner
        addRow(at, reached, row, below_first, tag);
        for (uint b = 0u; b < below_count; ++b, ++spent) {
            reached = max(reached, frame.origin.x + xAt(profile_line[profileAt(slab) + b], y));
            addRow(at + 1u + b, reached, row, profile_owner[profileAt(slab) + b], tag);
        }
    }
}

uint break_count;
double break_x[kLeafBreaks], break_rest[kLeafBreaks];
int break_above[kLeafBreaks];
uint break_before[kLeafBreaks], break_after[kLeafBreaks], break_order[kLeafBreaks];
void addBreak(FineCoordinate x, int above, uint before, uint after) {
    if (break_count < kLeafBreaks) {
        break_x[break_count] = x.grid;
        break_rest[break_count] = x.rest;
        break_above[break_count] = above;
        break_before[break_count] = before;
        break_after[break_count] = after;
        break_order[break_count] = break_count;
    }
    ++break_count;
}
FineCoordinate breakX(uint place) { return FineCoordinate(break_x[break_order[place]], break_rest[break_order[place]]); }

/// Of the profile above the slab, then of the one in it.
void addBreaks(uint slab) {
    uint before = leaf.above_first;
    for (uint k = 0u; k < leaf.above_count + below_count; ++k, ++spent) {
        bool above = k < leaf.above_count;
        if (k == leaf.above_count) before = below_first;
        uint at = above ? profileAt(slab + 1u) + k : profileAt(slab) + (k - leaf.above_count), after = profile_owner[at];
        addBreak(xOf(topPoint(profile_line[at])), above ? 1 : -1, before, after);
        before = after;
    }
}

/// Between the cell's borders by ascending abscissa.
void collectBreaks(uint slab, uint first) {
    break_count = 0u;
    addBreak(border(frame.cell.min.x), 0, kBackground, kBackground);
    for (uint h = first; h < leaf.next_horizontal; ++h, ++spent) {
        addBreak(xOf(pointFrom(horizontals[horizontalAt(h)].enter)), 0, kBackground, kBackground);
        addBreak(xOf(pointFrom(horizontals[horizontalAt(h)].exit)), 0, kBackground, kBackground);
    }
    addBreaks(slab);
    uint count = min(break_count, kLeafBreaks);
    for (uint i = 2u; i < count; ++i, spent += 2u) {
        FineCoordinate x = FineCoordinate(break_x[i], break_rest[i]);
        uint j = i;
        for (; j > 1u && difference(x, breakX(j - 1u)) < 0.0lf; --j, ++spent) break_order[j] = break_order[j - 1u];
        break_order[j] = i;
    }
    addBreak(border(frame.cell.max.x), 0, kBackground, kBackground);
}

/// How often each owner lies above an ordinate, less how often below.
uint balance_count;
uint balance_owner[kLeafOwners];
int balances[kLeafOwners];
void addBalance(uint owner, int by) {
    if (by == 0) return;
    uint at = 0u;
    while (at < balance_count && balance_owner[at] != owner) {
        ++at;
        ++spent;
    }
    bool known = at < balance_count;
    int sum = (known ? balances[at] : 0) + by;
    balance_owner[at] = owner;
    balances[at] = sum;
    if (!known) ++balance_count;
    if (sum != 0) return;
    --balance_count;
    for (; at < balance_count; ++at, ++spent) {
        balance_owner[at] = balance_owner[at + 1u];
        balances[at] = balances[at + 1u];
    }
}

void emitHorizontal(FineCoordinate from, FineCoordinate to, uint over, uint under, uint first) {
    if (difference(from, to) > 0.0lf) {
        FineCoordinate x = from;
        from = to;
        to = x;
        uint owner = over;
        over = under;
        under = owner;
    }
    uvec2 key = unpackUint2x32(closingKeyOf(top_y));
    LineRef line = LineRef(0xffffffffu, kFirstEdge - 1u);
    bool found = false;
    for (uint h = first; !found && h < leaf.next_horizontal; ++h, ++spent) {
        GpuLine flat_line = horizontals[horizontalAt(h)];
        found = difference(xOf(pointFrom(flat_line.enter)), from) <= 0.0lf &&
                difference(to, xOf(pointFrom(flat_line.exit))) <= 0.0lf;
        if (found) {
            key = uvec2(flat_line.key_low, flat_line.key_high);
            line = LineRef(flat_line.line_i, flat_line.line_j);
        }
    }
    if (!found && difference(to, from) > kUnsure) ++leaf.closings;
    emit(key, line, over, under, finePoint(to, top_y), finePoint(from, top_y));
}

/// The counts as pairs of one owner above and one below; the counts sum to 0.
void emitPairs(FineCoordinate from, FineCoordinate to, uint first) {
    uint p = 0u, q = 0u;
    int p_left = 0, q_left = 0;
    for (;; spent += 4u) {
        while (p_left == 0 && p < balance_count) {
            p_left = max(0, balances[p++]);
            ++spent;
        }
        while (q_left == 0 && q < balance_count) {
            q_left = max(0, -balances[q++]);
            ++spent;
        }
        if (p_left == 0 || q_left == 0) break;
        --p_left;
        --q_left;
        emitHorizontal(from, to, balance_owner[p - 1u], balance_owner[q - 1u], first);
    }
}

/// Owners change across an ordinate along horizontal lines, or along closing pieces. [E16]
void emitHorizontals(uint slab) {
    uint first = leaf.next_horizontal;
    while (leaf.next_horizontal < leaf.horizontals &&
           keyEqual(keyFrom(horizontals[horizontalAt(leaf.next_horizontal)].in0), top_key)) {
        ++leaf.next_horizontal;
        ++spent;
    }
    if (first == leaf.next_horizontal && same_profiles) return;
    collectBreaks(slab, first);
    balance_count = 0u;
    addBalance(leaf.above_first, 1);
    addBalance(below_first, -1);
    for (uint i = 0u; i + 1u < min(break_count, kLeafBreaks); ++i, spent += 10u) {
        uint here = break_order[i];
        addBalance(break_after[here], break_above[here]);
        addBalance(break_before[here], -break_above[here]);
        FineCoordinate from = breakX(i), to = breakX(i + 1u);
        if (balance_count == 0u || difference(from, to) == 0.0lf) continue;
        emitPairs(from, to, first);
    }
}

void readSlab(uint slab) {
    GpuKey low = keys[keyAt(slab)], high = keys[keyAt(slab + 1u)];
    top_key = keyFrom(low.key);
    bottom_key = keyFrom(high.key);
    top_y = ordinateOf(low);
    bottom_y = ordinateOf(high);
}

/// The lines of a leaf, and what the dispatch before knew of them.
void load() {
    left_lines = open_lines = uint64_t(0u);
    for (uint i = 0u; i < leaf.triangles; ++i, ++spent) local_plane[i] = localPlaneAt(i);
    for (uint i = 0u; i < leaf.lines; ++i, ++spent) {
        uint span = lines[lineAt(i)].span, last = leaf.keys - 1u;
        uint begins = min(beginOf(span), last), enters = min(enterOf(span), last);
        uint exits = min(exitOf(span), last), ends = min(endOf(span), last);
        bool inside = enters < exits, passes_left = (span & kPassesLeft) != 0u;
        if (!inside) enters = exits = ends;
        if (inside ? lines[lineAt(i)].side_before >= 0 : !passes_left) begins = enters;
        if (inside && lines[lineAt(i)].side_after >= 0) ends = exits;
        spans[i] = begins | enters << 8 | exits << 16 | ends << 24;
        if (begins < enters || exits < ends) left_lines |= bitOf(i);
        bounds[i] = lines[lineAt(i)].bounds;
        FinePoint enter = pointFrom(lines[lineAt(i)].enter);
        enter_x[i] = localX(frame, enter);
        enter_grid[i] = enter.grid.y;
        enter_rest[i] = enter.rest.y;
        exit_x[i] = localX(frame, pointFrom(lines[lineAt(i)].exit));
        slopes[i] = lines[lineAt(i)].slope;
        entry_line[i] = words[wordAt(kWordEntry + i)];
        noted[i] = noted[kLeafLines + i] = 0xffffffffu;
    }
    for (uint k = 0u; k < leaf.order; ++k, ++spent) {
        uint i = words[wordAt(kWordOrder + k)];
        order[k] = i;
        x_ends[i] = tracks[lineAt(i)].x;
        noted[notedAt(leaf.slab, i)] = tracks[lineAt(i)].noted;
        if (tracks[lineAt(i)].is_open != 0u) open_lines |= bitOf(i);
        left_owner[i] = tracks[lineAt(i)].left;
        right_owner[i] = tracks[lineAt(i)].right;
    }
    for (uint k = 0u; k < leaf.above_count; ++k, ++spent) {
        profile_line[profileAt(leaf.slab + 1u) + k] = words[wordAt(kWordAbove + 2u * k)];
        profile_owner[profileAt(leaf.slab + 1u) + k] = words[wordAt(kWordAbove + 2u * k + 1u)];
    }
}

void store() {
    uint running = leaf.slab + 1u < leaf.keys ? 1u : 0u;
    for (uint k = 0u; k < leaf.order * running; ++k, ++spent) {
        uint i = order[k];
        words[wordAt(kWordOrder + k)] = i;
        tracks[lineAt(i)].x = x_ends[i];
        tracks[lineAt(i)].noted = noted[notedAt(leaf.slab, i)];
        tracks[lineAt(i)].is_open = holds(open_lines, i) ? 1u : 0u;
        tracks[lineAt(i)].left = left_owner[i];
        tracks[lineAt(i)].right = right_owner[i];
    }
    for (uint k = 0u; k < leaf.above_count * running; ++k, ++spent) {
        words[wordAt(kWordAbove + 2u * k)] = profile_line[profileAt(leaf.slab + 1u) + k];
        words[wordAt(kWordAbove + 2u * k + 1u)] = profile_owner[profileAt(leaf.slab + 1u) + k];
    }
}

void main() {
    if (!openLeaf()) return;
    load();
    bool fits = true;
    for (; leaf.slab + 1u < leaf.keys && spent < loopBudget() && fits; ++leaf.slab, spent += 50u) {
        readSlab(leaf.slab);
        locate(leaf.slab);
        locateFinely();
        sweep(leaf.slab);
        if (undecided) break;
        break_count = 0u;
        updatePieces();
        if (leaf.slab > 0u) emitHorizontals(leaf.slab);
        fits = break_count <= kLeafBreaks;
        emitRows(leaf.slab);
        leaf.above_first = below_first;
        leaf.above_count = below_count;
    }
    if (undecided || !fits) {
        if (fits && !kExact) {
            leaf.state = kLeafUndecided;
            leaf_cells[status.cells_room + atomicAdd(status.undecided, 1u)] = leaf.cell;
        } else {
            handBack();
        }
    } else if (leaf.slab + 1u < leaf.keys) {
        atomicAdd(status.unfinished, 1u);
    } else {
        for (uint64_t bits = open_lines; bits != uint64_t(0u); bits &= bits - uint64_t(1u), ++spent)
            closePiece(lowest(bits), pointFrom(lines[lineAt(lowest(bits))].exit));
        leaf.state = kLeafDone;
        leaf_cells[2u * status.cells_room + push.first + leaf_slot] = 1u;
        atomicAdd(status.swept, 1u);
        atomicAdd(status.slabs, leaf.keys - 1u);
        atomicAdd(status.depth_lines, leaf.depth_lines);
        atomicAdd(status.exact_depth, leaf.compared_exactly);
        atomicAdd(status.closings, leaf.closings);
    }
    store();
    countLoops();
    leaves[leaf_slot] = leaf;
}
