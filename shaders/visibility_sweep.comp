#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// The owners of a leaf, slab by slab: analytic/slab_sweep.cpp. A dispatch sweeps as many slabs as the budget of loops
// allows; what a leaf knows stays in its buffers until the next.
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const bool kExact = false;  // comparisons that the filter leaves open are decided
#include "shared/visibility_buffers.glsl"
#include "shared/visibility_int64.glsl"
#include "shared/line_key.glsl"
#include "shared/visibility_leaf.glsl"
#include "shared/exact_sign.glsl"

// After this many loops a leaf waits for the next dispatch; a slab takes some hundreds. A leaf that needs exact
// comparisons runs alone.
const uint kBudget = 3000u;
const uint kExactBudget = 30000u;
const uint kExactLoops = 400u;  // of one comparison

const uint kBorderLine = 0xffffffffu;  // in the place of a line: the cell's border
// Two abscissae nearer than this may stand in any order: each carries 5 roundings of at most 2^-49 px.
const double kUnsure = 1.7763568394002505e-14lf;
// Canonical points are rounded to multiples of 2^-76 px: each of one line's two ends may be off by one of them.
const double kSame = 2.6469779601696886e-23lf;

bool undecided = false;
uint mask_bits;
double y_mid;
OrderKey top_key, bottom_key;
FineCoordinate top_y, bottom_y;
uint below_first, below_count;

FineCoordinate ordinateOf(GpuKey key) { return FineCoordinate(key.y[0], key.y[1]); }
double localY(FineCoordinate y) { return (y.grid - frame.origin.y) + y.rest; }
uint ordered_line(uint i) { return words[wordAt(kWordOrder + i)]; }

double xAt(uint i, FineCoordinate y) {
    FinePoint from = pointFrom(lines[lineAt(i)].enter);
    double dy = (y.grid - from.grid.y) + (y.rest - from.rest.y);
    return localX(frame, from) + dy * lines[lineAt(i)].slope;
}

void emit(uvec2 key, LineRef line, uint left, uint right, FinePoint a, FinePoint b) {
    if (left == right) return;
    uint at = atomicAdd(status.pieces, 1u);
    if (at < status.pieces_room)
        pieces[at] = GpuPiece(pointTo(a), pointTo(b), key.x, key.y, line.i, line.j, left, right,
                              push.first + leaf_slot, 0u);
}

void closePiece(uint i, FinePoint end) {
    GpuTrack t = tracks[lineAt(i)];
    if (t.is_open == 0u) return;
    GpuLine line = lines[lineAt(i)];
    FinePoint start = pointFrom(t.start);
    double dx = difference(xOf(end), xOf(start)), dy = difference(yOf(end), yOf(start));
    bool along = dx * line.slope + dy >= 0.0lf;
    emit(uvec2(line.key_low, line.key_high), LineRef(line.line_i, line.line_j), along ? t.left : t.right,
         along ? t.right : t.left, along ? start : end, along ? end : start);
    tracks[lineAt(i)].is_open = 0u;
}

/// Lines end, carry on from the slab above, or begin.
void startSlab() {
    uint left = 0u;
    for (uint k = 0u; k < leaf.order; ++k, ++spent) {
        uint i = ordered_line(k);
        tracks[lineAt(i)].x_top = tracks[lineAt(i)].x_bottom;
        tracks[lineAt(i)].top = tracks[lineAt(i)].bottom;
        tracks[lineAt(i)].bottom_known = 0u;
        bool ends = keyEqual(keyFrom(lines[lineAt(i)].in1), top_key);
        if (ends) closePiece(i, pointFrom(lines[lineAt(i)].exit));
        if (!ends) words[wordAt(kWordOrder + left++)] = i;
    }
    leaf.order = left;
    while (leaf.next_entry < leaf.entries) {
        uint i = words[wordAt(kWordEntry + leaf.next_entry)];
        if (keyLess(top_key, keyFrom(lines[lineAt(i)].in0))) break;
        ++leaf.next_entry;
        ++spent;
        tracks[lineAt(i)].top = lines[lineAt(i)].enter;
        tracks[lineAt(i)].x_top = localX(frame, pointFrom(lines[lineAt(i)].enter));
        tracks[lineAt(i)].bottom_known = 0u;  // an event where the line begins is its top, not its bottom
        words[wordAt(kWordOrder + leaf.order++)] = i;
    }
}

void noteEvent(uint i, double point[4]) {
    if (tracks[lineAt(i)].bottom_known != 0u) return;
    tracks[lineAt(i)].bottom = point;
    tracks[lineAt(i)].bottom_known = 1u;
}

/// -1, 0 or 1 as line p runs left of, on or right of line q in the slab.
int compare(uint p, uint q) {
    double d = tracks[lineAt(p)].x_mid - tracks[lineAt(q)].x_mid;
    FinePoint p0 = pointFrom(tracks[lineAt(p)].top), q0 = pointFrom(tracks[lineAt(q)].top);
    FinePoint p1 = pointFrom(tracks[lineAt(p)].bottom), q1 = pointFrom(tracks[lineAt(q)].bottom);
    double fine = ((p0.grid.x - q0.grid.x) + (p1.grid.x - q1.grid.x)) + ((p0.rest.x - q0.rest.x) + (p1.rest.x - q1.rest.x));
    if (abs(d) > kUnsure) return d > 0.0lf ? 1 : -1;
    return abs(fine) <= kSame ? 0 : (fine > 0.0lf ? 1 : -1);
}

/// Points at the slab's bottom, then the order at its middle.
void locate() {
    while (leaf.next_event < leaf.events && keyLess(keyFrom(events[eventAt(leaf.next_event)].key), bottom_key)) {
        ++leaf.next_event;
        ++spent;
    }
    for (uint e = leaf.next_event; e < leaf.events; ++e, ++spent) {
        GpuEvent event = events[eventAt(e)];
        if (!keyEqual(keyFrom(event.key), bottom_key)) break;
        noteEvent(event.p, event.point);
        noteEvent(event.q, event.point);
    }
    for (uint k = 0u; k < leaf.order; ++k, ++spent) {
        uint i = ordered_line(k);
        bool ends = keyEqual(keyFrom(lines[lineAt(i)].in1), bottom_key);
        bool known = tracks[lineAt(i)].bottom_known != 0u || ends;
        FinePoint bottom = pointAtY(carrierFrom(lines[lineAt(i)]), bottom_y);
        double x_bottom = xAt(i, bottom_y);
        if (known) {
            bottom = pointFrom(tracks[lineAt(i)].bottom);
            if (ends) bottom = pointFrom(lines[lineAt(i)].exit);
            x_bottom = localX(frame, bottom);
        }
        tracks[lineAt(i)].bottom = pointTo(bottom);
        tracks[lineAt(i)].x_bottom = x_bottom;
        tracks[lineAt(i)].x_mid = 0.5lf * (tracks[lineAt(i)].x_top + x_bottom);
    }
    for (uint k = 1u; k < leaf.order; ++k, spent += 2u) {
        uint i = ordered_line(k), j = k;
        for (; j > 0u && compare(ordered_line(j - 1u), i) > 0; --j, ++spent)
            words[wordAt(kWordOrder + j)] = ordered_line(j - 1u);
        words[wordAt(kWordOrder + j)] = i;
    }
}

/// Half the sum of a line's abscissae at the slab's ends, or of a border's, from the anchor.
dd exactMiddle(uint line, double border_grid) {
    uint i = line == kBorderLine ? 0u : line;
    dd sum = ddAdd(offsetFrom(xOf(pointFrom(tracks[lineAt(i)].top)), push.anchor_x),
                   offsetFrom(xOf(pointFrom(tracks[lineAt(i)].bottom)), push.anchor_x));
    if (line == kBorderLine) return offsetFrom(border(border_grid), push.anchor_x);
    return dd(0.5lf * sum.hi, 0.5lf * sum.lo);
}

/// Decided at the canonical middle, which knows nothing of the cell's frame.
bool exactlyInFront(LocalPlane p, LocalPlane q, uint left, uint right) {
    if (!kExact || spent + kExactLoops > 2u * kExactBudget) {
        undecided = true;
        return false;
    }
    ++leaf.compared_exactly;
    spent += kExactLoops;
    dd x = ddAdd(exactMiddle(left, frame.cell.min.x), exactMiddle(right, frame.cell.max.x));
    dd y = ddAdd(offsetFrom(top_y, push.anchor_y), offsetFrom(bottom_y, push.anchor_y));
    int sign = depthDifferenceSign(planeAt(p.plane), planeAt(q.plane), dd(0.5lf * x.hi, 0.5lf * x.lo),
                                   dd(0.5lf * y.hi, 0.5lf * y.lo));
    return sign != 0 ? sign > 0 : p.owner < q.owner;
}

uint seen(uint left, uint right) {
    double x0 = left == kBorderLine ? (frame.cell.min.x - frame.origin.x) + border(0.0lf).rest : tracks[lineAt(left)].x_mid;
    double x1 =
        right == kBorderLine ? (frame.cell.max.x - frame.origin.x) + border(0.0lf).rest : tracks[lineAt(right)].x_mid;
    double x = 0.5lf * (x0 + x1);
    bool any_seen = false;
    LocalPlane best = LocalPlane(0.0lf, 0.0lf, 0.0lf, 0.0lf, 0u, kBackground);
    for (uint bits = mask_bits; bits != 0u; bits &= bits - 1u, spent += kExact ? 8u : 1u) {
        LocalPlane p = localPlaneAt(uint(findLSB(bits)));
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

/// Walks the slab's middle from left to right; labels the lines where the owner changes.
void sweep(uint slab) {
    mask_bits = 0u;
    for (uint i = 0u; i < leaf.lines; ++i, ++spent) {
        GpuLine line = lines[lineAt(i)];
        if (line.side_before >= 0 && line.side_after >= 0) continue;
        if (keyLess(top_key, keyFrom(line.y0)) || !keyLess(top_key, keyFrom(line.y1))) continue;
        int side = !keyLess(top_key, keyFrom(line.in1)) ? line.side_after
                                                        : (keyLess(top_key, keyFrom(line.in0)) ? line.side_before : 0);
        if (side < 0) mask_bits ^= line.bounds;
    }
    y_mid = 0.5lf * (localY(top_y) + localY(bottom_y));
    uint owner = 0u, first = kBorderLine, k = 0u;
    below_count = 0u;
    // The first turn asks what is seen at the left border, each other one passes the lines of one place.
    for (uint turn = 0u; turn == 0u || k < leaf.order; ++turn, spent += 3u) {
        uint chosen = kBorderLine;
        if (turn > 0u) {
            first = chosen = ordered_line(k);
            for (; k < leaf.order; ++k, ++spent) {
                uint i = ordered_line(k);
                if (i != first && compare(i, first) != 0) break;
                mask_bits ^= lines[lineAt(i)].bounds;
                LineRef ref = LineRef(lines[lineAt(i)].line_i, lines[lineAt(i)].line_j);
                LineRef best = LineRef(lines[lineAt(chosen)].line_i, lines[lineAt(chosen)].line_j);
                bool ref_edge = ref.j >= kFirstEdge, best_edge = best.j >= kFirstEdge;
                if (ref_edge != best_edge ? ref_edge : refBefore(ref, best)) chosen = i;
            }
        }
        uint after = seen(first, k < leaf.order ? ordered_line(k) : kBorderLine);
        if (turn == 0u) {
            below_first = owner = after;
            continue;
        }
        if (after == owner) continue;
        tracks[lineAt(chosen)].labelled_in = slab;
        tracks[lineAt(chosen)].new_left = owner;
        tracks[lineAt(chosen)].new_right = after;
        words[wordAt(kWordBelow + 2u * below_count)] = chosen;
        words[wordAt(kWordBelow + 2u * below_count + 1u)] = after;
        ++below_count;
        owner = after;
    }
}

void updatePieces(uint slab) {
    for (uint k = 0u; k < leaf.order; ++k, ++spent) {
        uint i = ordered_line(k);
        GpuTrack t = tracks[lineAt(i)];
        bool labelled = t.labelled_in == slab;
        if (t.is_open != 0u && labelled && t.left == t.new_left && t.right == t.new_right) continue;
        if (t.is_open == 0u && !labelled) continue;
        closePiece(i, pointFrom(t.top));
        if (!labelled) continue;
        tracks[lineAt(i)].is_open = 1u;
        tracks[lineAt(i)].left = t.new_left;
        tracks[lineAt(i)].right = t.new_right;
        tracks[lineAt(i)].start = t.top;
    }
}

void emitRows() {
    for (int row = int(floor(top_y.grid - 0.5lf)); double(row) + 0.5lf <= bottom_y.grid; ++row, spent += 2u) {
        FineCoordinate y = sampleRow(row);
        OrderKey key = orderKey(y, frame.origin.y);
        if (keyLess(key, top_key) || !keyLess(key, bottom_key)) continue;
        uint tag = push.first + leaf_slot, at = atomicAdd(status.rows, 1u + below_count);
        double reached = frame.cell.min.x + border(0.0lf).rest;  // rounding must not exchange the ends of a thin owner
        addRow(at, reached, row, below_first, tag);
        for (uint b = 0u; b < below_count; ++b, ++spent) {
            reached = max(reached, frame.origin.x + xAt(words[wordAt(kWordBelow + 2u * b)], y));
            addRow(at + 1u + b, reached, row, words[wordAt(kWordBelow + 2u * b + 1u)], tag);
        }
    }
}

/// Whether two profiles change owners at the same lines.
bool sameProfiles() {
    if (leaf.above_first != below_first || leaf.above_count != below_count) return false;
    bool same = true;
    for (uint k = 0u; k < 2u * below_count; ++k, ++spent)
        same = same && words[wordAt(kWordAbove + k)] == words[wordAt(kWordBelow + k)];
    return same;
}

uint break_count;
void addBreak(FineCoordinate x, int above, uint before, uint after) {
    if (break_count < kLeafBreaks)
        breaks[breakAt(break_count)] = GpuBreak(double[2](x.grid, x.rest), above, before, after, 0u);
    ++break_count;
}
FineCoordinate breakX(uint i) { return FineCoordinate(breaks[breakAt(i)].x[0], breaks[breakAt(i)].x[1]); }

void addBreaks(uint profile, uint first, uint count, int sign) {
    uint before = first;
    for (uint k = 0u; k < count; ++k, ++spent) {
        uint after = words[wordAt(profile + 2u * k + 1u)];
        addBreak(xOf(pointFrom(tracks[lineAt(words[wordAt(profile + 2u * k)])].top)), sign, before, after);
        before = after;
    }
}

/// Between the cell's borders by ascending abscissa.
void collectBreaks(uint first) {
    break_count = 0u;
    addBreak(border(frame.cell.min.x), 0, kBackground, kBackground);
    for (uint h = first; h < leaf.next_horizontal; ++h, ++spent) {
        addBreak(xOf(pointFrom(horizontals[horizontalAt(h)].enter)), 0, kBackground, kBackground);
        addBreak(xOf(pointFrom(horizontals[horizontalAt(h)].exit)), 0, kBackground, kBackground);
    }
    addBreaks(kWordAbove, leaf.above_first, leaf.above_count, 1);
    addBreaks(kWordBelow, below_first, below_count, -1);
    uint count = min(break_count, kLeafBreaks);
    for (uint i = 2u; i < count; ++i, spent += 2u) {
        GpuBreak item = breaks[breakAt(i)];
        FineCoordinate x = FineCoordinate(item.x[0], item.x[1]);
        uint j = i;
        for (; j > 1u && difference(x, breakX(j - 1u)) < 0.0lf; --j, ++spent) breaks[breakAt(j)] = breaks[breakAt(j - 1u)];
        breaks[breakAt(j)] = item;
    }
    addBreak(border(frame.cell.max.x), 0, kBackground, kBackground);
}

/// How often each owner lies above an ordinate, less how often below.
uint balance_count;
void addBalance(uint owner, int by) {
    if (by == 0) return;
    uint at = 0u;
    while (at < balance_count && words[wordAt(kWordBalance + 2u * at)] != owner) {
        ++at;
        ++spent;
    }
    bool known = at < balance_count;
    int sum = (known ? int(words[wordAt(kWordBalance + 2u * at + 1u)]) : 0) + by;
    words[wordAt(kWordBalance + 2u * at)] = owner;
    words[wordAt(kWordBalance + 2u * at + 1u)] = uint(sum);
    if (!known) ++balance_count;
    if (sum != 0) return;
    --balance_count;
    for (; at < balance_count; ++at, ++spent) {
        words[wordAt(kWordBalance + 2u * at)] = words[wordAt(kWordBalance + 2u * at + 2u)];
        words[wordAt(kWordBalance + 2u * at + 1u)] = words[wordAt(kWordBalance + 2u * at + 3u)];
    }
}
int balanceOf(uint at) { return int(words[wordAt(kWordBalance + 2u * at + 1u)]); }

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
            p_left = max(0, balanceOf(p++));
            ++spent;
        }
        while (q_left == 0 && q < balance_count) {
            q_left = max(0, -balanceOf(q++));
            ++spent;
        }
        if (p_left == 0 || q_left == 0) break;
        --p_left;
        --q_left;
        emitHorizontal(from, to, words[wordAt(kWordBalance + 2u * (p - 1u))], words[wordAt(kWordBalance + 2u * (q - 1u))],
                       first);
    }
}

/// Owners change across an ordinate along horizontal lines, or along closing pieces. [E16]
void emitHorizontals() {
    uint first = leaf.next_horizontal;
    while (leaf.next_horizontal < leaf.horizontals &&
           keyEqual(keyFrom(horizontals[horizontalAt(leaf.next_horizontal)].in0), top_key)) {
        ++leaf.next_horizontal;
        ++spent;
    }
    if (first == leaf.next_horizontal && sameProfiles()) return;
    collectBreaks(first);
    balance_count = 0u;
    addBalance(leaf.above_first, 1);
    addBalance(below_first, -1);
    for (uint i = 0u; i + 1u < min(break_count, kLeafBreaks); ++i, spent += 10u) {
        GpuBreak here = breaks[breakAt(i)];
        addBalance(here.after, here.above);
        addBalance(here.before, -here.above);
        FineCoordinate from = FineCoordinate(here.x[0], here.x[1]), to = breakX(i + 1u);
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

void keepProfile() {
    for (uint k = 0u; k < 2u * below_count; ++k, ++spent) words[wordAt(kWordAbove + k)] = words[wordAt(kWordBelow + k)];
    leaf.above_first = below_first;
    leaf.above_count = below_count;
}

void main() {
    if (!openLeaf()) return;
    bool fits = true;
    uint budget = kExact ? kExactBudget : kBudget;
    for (; leaf.slab + 1u < leaf.keys && spent < budget && fits; ++leaf.slab, spent += 50u) {
        readSlab(leaf.slab);
        startSlab();
        locate();
        sweep(leaf.slab);
        if (undecided) break;
        break_count = 0u;
        updatePieces(leaf.slab);
        if (leaf.slab > 0u) emitHorizontals();
        fits = break_count <= kLeafBreaks;
        emitRows();
        keepProfile();
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
        for (uint k = 0u; k < leaf.order; ++k) closePiece(ordered_line(k), pointFrom(lines[lineAt(ordered_line(k))].exit));
        leaf.state = kLeafDone;
        leaf_cells[2u * status.cells_room + push.first + leaf_slot] = 1u;
        atomicAdd(status.swept, 1u);
        atomicAdd(status.slabs, leaf.keys - 1u);
        atomicAdd(status.depth_lines, leaf.depth_lines);
        atomicAdd(status.exact_depth, leaf.compared_exactly);
        atomicAdd(status.closings, leaf.closings);
    }
    countLoops();
    leaves[leaf_slot] = leaf;
}
