#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// Cells that one sheet of triangles covers need no sweep: analytic/sheet_certificate.cpp.
layout(local_size_x_id = 0) in;
#include "shared/visibility_buffers.glsl"
#include "shared/visibility_int64.glsl"
#include "shared/line_key.glsl"

// A slot of the table: the sides along and against an edge, as triangle * 4 + edge + 1; 0 where there is none.
uint slotWith(uint slot) { return table[2u * slot]; }
uint slotAgainst(uint slot) { return table[2u * slot + 1u]; }

uvec2 endsOf(uint side) {
    uint triangle = (side - 1u) >> 2, k = (side - 1u) & 3u;
    uint u = triangles[triangle].vertex[k], v = triangles[triangle].vertex[k == 2u ? 0u : k + 1u];
    return uvec2(min(u, v), max(u, v));
}

bool enter(uint base, uint room, uint triangle, uint k) {
    uint side = triangle * 4u + k + 1u;
    uvec2 ends = endsOf(side);
    uint slot = ((ends.x * 0x9e3779b1u) ^ (ends.y * 0x85ebca6bu)) >> 7 & (room - 1u);
    for (;;) {
        uint known = max(slotWith(base + slot), slotAgainst(base + slot));
        ++spent;
        if (known == 0u || endsOf(known) == ends) break;
        slot = (slot + 1u) & (room - 1u);
    }
    dvec2 a = cornerAt(triangle, k), b = cornerAt(triangle, k == 2u ? 0u : k + 1u);
    bool canonical = a.y < b.y || (a.y == b.y && a.x > b.x);
    uint at = 2u * (base + slot) + (canonical ? 0u : 1u);
    bool free = table[at] == 0u;
    if (free) table[at] = side;
    return free;
}

bool coveredOnce(GpuCell c, dvec2 p) {
    int inside = 0;
    bool sure = true;
    for (uint i = 0u; i < c.count; ++i, spent += 5u) {
        InnerDistance d = innerDistance(triangleAt(kept[c.begin + i]), p);
        sure = sure && abs(d.value) > d.error;
        inside += d.value > 0.0lf ? 1 : 0;
    }
    return sure && inside == 1;
}

bool crossingBefore(GpuCrossing a, GpuCrossing b) {
    if (a.row != b.row) return a.row < b.row;
    if (a.x != b.x) return a.x < b.x;
    return a.slope < b.slope;
}

/// Shell's sort, with gaps that suit some hundred items. False where it takes more loops than there are.
bool sortCrossings(uint base, uint count) {
    uint moves = 0u, most = loopBudget();
    for (uint gap = 57u; gap > 0u; gap = gap == 57u ? 23u : (gap == 23u ? 10u : (gap == 10u ? 4u : (gap == 4u ? 1u : 0u))))
        for (uint i = gap; i < count; ++i, spent += 2u) {
            GpuCrossing item = crossings[base + i];
            uint j = i;
            for (; j >= gap && crossingBefore(item, crossings[base + j - gap]); j -= gap, ++moves, ++spent)
                crossings[base + j] = crossings[base + j - gap];
            crossings[base + j] = item;
            if (moves > most) return false;
        }
    return true;
}

/// 0: labels do not chain; 1: they do; 2: two crossings at one place, in an order that is the host's.
uint chains(uint base, uint count) {
    uint result = 1u;
    for (uint i = 0u; i + 1u < count; ++i, ++spent) {
        GpuCrossing a = crossings[base + i], b = crossings[base + i + 1u];
        if (a.row != b.row) continue;
        if (a.x == b.x && a.slope == b.slope) return 2u;
        if (a.after != b.before) result = 0u;
    }
    return result;
}

/// Of the triangles, the owner of the one that holds a point furthest inside.
uint holderOf(GpuCell c, dvec2 p) {
    uint holder = kept[c.begin];
    double best = 0.0lf;
    for (uint i = 0u; i < c.count; ++i, spent += 5u) {
        double d = innerDistance(triangleAt(kept[c.begin + i]), p).value;
        if (i > 0u && !(best < d)) continue;
        best = d;
        holder = kept[c.begin + i];
    }
    return triangles[holder].owner;
}

void emitRows(GpuCell c, uint base, uint count) {
    Cell cell = cellOf(c);
    double start = c.min_x + border(0.0lf).rest, middle = 0.5lf * (cell.min.x + cell.max.x);
    uint next = 0u;
    for (int row = int(floor(c.min_y - 0.5lf)); double(row) + 0.5lf <= cell.max.y; ++row) {
        spent += 10u;
        if (!(double(row) + 0.5lf > c.min_y)) continue;
        uint first = next;
        while (next < count && crossings[base + next].row == row) ++next;
        spent += 2u * (next - first);
        uint at = atomicAdd(status.rows, 1u + next - first);
        addRow(at, start, row, next > first ? crossings[base + first].before : kBackground, kNoTag);
        for (uint k = first; k < next; ++k)
            addRow(at + 1u + k - first, crossings[base + k].x, row, crossings[base + k].after, kNoTag);
        if (next == first) addRow(at, start, row, holderOf(c, dvec2(middle, double(row) + 0.5lf)), kNoTag);
    }
}

void handBack(uint id) {
    cells[id].state = kCellHanded;
    handed[atomicAdd(status.handed, 1u)] = id;
}

GpuPiece pieceOf(uint64_t key, LineRef line, uint left, uint right, FinePoint a, FinePoint b) {
    double from[4] = double[4](a.grid.x, a.grid.y, a.rest.x, a.rest.y);
    double to[4] = double[4](b.grid.x, b.grid.y, b.rest.x, b.rest.y);
    uvec2 halves = unpackUint2x32(key);
    return GpuPiece(from, to, halves.x, halves.y, line.i, line.j, left, right, kNoTag, 0u);
}

void certify(uint id) {
    GpuCell c = cells[id];
    if (c.state != kCellOpen) return;
    // One workgroup size for small cells, one for large: the others' turn is another dispatch.
    if ((c.count > push.sheet_small) != (gl_WorkGroupSize.x == 1u)) return;
    if (c.count > push.sheet_most) {
        handBack(id);
        return;
    }
    Cell cell = cellOf(c);
    uint room = 16u;
    while (room < 3u * c.count) room *= 2u;
    spent = 40u + 3u * room;
    uint base = atomicAdd(status.table, room), list = atomicAdd(status.crossings, 4u * c.count + 96u);
    if (base + room > status.table_room || list + 4u * c.count + 96u > status.crossings_room) return;
    for (uint i = 0u; i < 2u * room; ++i) table[2u * base + i] = 0u;
    bool paired = true;
    for (uint i = 0u; i < 3u * c.count; ++i, spent += 2u) {
        uint triangle = kept[c.begin + i / 3u], k = i % 3u;
        if (!mayMeet(cornerAt(triangle, k), cornerAt(triangle, k == 2u ? 0u : k + 1u), cell)) continue;
        if (!enter(base, room, triangle, k)) {
            paired = false;
            break;
        }
    }
    if (!paired) return;
    uint edges = 0u;  // moved to the front of the table
    for (uint i = 0u; i < room; ++i) {
        uint along = slotWith(base + i), against = slotAgainst(base + i);
        if ((along == 0u) != (against == 0u)) paired = false;
        if (along == 0u || against == 0u) continue;
        table[2u * (base + edges)] = along;
        table[2u * (base + edges) + 1u] = against;
        ++edges;
    }
    if (!paired) return;
    dvec2 size = cell.max - cell.min;
    // Two generic points: a vertex or an edge may lie on one of them.
    if (!coveredOnce(c, cell.min + size * dvec2(0.5078125lf, 0.4765625lf)) &&
        !coveredOnce(c, cell.min + size * dvec2(0.2734375lf, 0.6171875lf)))
        return;
    CellFrame frame = frameOf(c);
    uint first_piece = atomicAdd(status.pieces, edges), found = 0u, most = 4u * c.count + 96u;
    bool fits = first_piece + edges <= status.pieces_room;
    for (uint e = 0u; e < edges; ++e, spent += 3u) {
        uint along = slotWith(base + e) - 1u, against = slotAgainst(base + e) - 1u;
        uint left = triangles[along >> 2].owner, right = triangles[against >> 2].owner;
        uint ref = min(along, against);  // triangle * 4 + edge: the order of LineRefs
        Carrier carrier = edgeAt(ref >> 2, ref & 3u);
        bool flat_edge = isHorizontal(carrier);
        LeafHorizontal h;
        LeafLine line = emptyLine(carrier);
        bool emitted;
        if (flat_edge)
            emitted = clipHorizontalEdge(frame, carrier, h);
        else
            emitted = clipEdge(frame, line) && runsInside(line);
        FinePoint from = line.enter, to = line.exit;
        if (flat_edge) {
            from = h.high;
            to = h.low;
        }
        GpuPiece piece = pieceOf(lineKeyOf(carrier), carrier.ref, left, right, from, to);
        if (!emitted) piece.left = piece.right = kBackground;  // nothing
        if (fits) pieces[first_piece + e] = piece;
        if (!emitted || flat_edge) continue;
        for (int row = int(floor(line.enter.grid.y - 0.5lf)); double(row) + 0.5lf <= line.exit.grid.y; ++row, ++spent) {
            FineCoordinate y = sampleRow(row);
            OrderKey key = orderKey(y, frame.origin.y);
            if (keyLess(key, line.in0) || !keyLess(key, line.in1)) continue;
            double dy = (y.grid - line.enter.grid.y) + (y.rest - line.enter.rest.y);
            double x = frame.origin.x + (localX(frame, line.enter) + dy * line.slope);
            if (found < most) crossings[list + found] = GpuCrossing(x, line.slope, row, left, right, 0u);
            ++found;
        }
    }
    uint chained = 2u;
    if (found <= most && sortCrossings(list, found)) chained = chains(list, found);
    if (chained != 1u)
        for (uint e = 0u; e < edges; ++e)
            if (fits) pieces[first_piece + e].left = pieces[first_piece + e].right;
    if (chained == 2u) {
        handBack(id);
    } else if (chained == 1u) {
        emitRows(c, list, found);
        cells[id].state = kCellDone;
        atomicAdd(status.certified, 1u);
    }
}

void main() {
    if (gl_GlobalInvocationID.x >= push.count) return;
    certify(push.first + gl_GlobalInvocationID.x);
    countLoops();
}
