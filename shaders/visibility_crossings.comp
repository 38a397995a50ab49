#version 460
// Where the lines of a leaf meet: analytic/leaf_lines.cpp, addCrossings().
layout(local_size_x = 64) in;
#include "shared/visibility_buffers.glsl"
#include "shared/visibility_leaf.glsl"

/// Edges that meet in a vertex cross nowhere else.
bool meetInVertex(GpuLine p, GpuLine q) {
    dvec2 pa = pair(p.a), pb = pair(p.b), qa = pair(q.a), qb = pair(q.b);
    bool edges = p.line_j >= kFirstEdge && q.line_j >= kFirstEdge;
    return edges && (pa == qa || pa == qb || pb == qa || pb == qb);
}

/// What may meet, in the host's order: i + 256 j.
uint candidates() {
    uint count = 0u;
    for (uint i = 0u; i < leaf.lines; ++i, spent += 2u) {
        GpuLine p = lines[lineAt(i)];
        OrderKey p0 = keyFrom(p.in0), p1 = keyFrom(p.in1);
        if (!keyLess(p0, p1)) continue;
        for (uint j = i + 1u; j < leaf.lines; ++j, ++spent) {
            OrderKey q0 = keyFrom(lines[lineAt(j)].in0), q1 = keyFrom(lines[lineAt(j)].in1);
            if (!keyLess(q0, q1) || keyLess(p1, q0) || keyLess(q1, p0)) continue;
            // Abscissae carry a few roundings of the cell's size, far below the grid.
            const double pad = 2.3283064365386963e-10lf;
            if (p.x_high + pad < lines[lineAt(j)].x_low || lines[lineAt(j)].x_high + pad < p.x_low) continue;
            if (count < kLeafWords - kWordPairs) words[wordAt(kWordPairs + count)] = i + 256u * j;
            ++count;
        }
    }
    return count;
}

bool addEvent(OrderKey key, uint p, uint q, FinePoint point) {
    if (leaf.events >= kLeafEvents) return false;
    events[eventAt(leaf.events++)] = GpuEvent(keyTo(key), pointTo(point), p, q, 0u, 0u);
    return true;
}

bool crossing(Carrier p, Carrier q, out FinePoint point) {
    bool p_edge = isEdge(p), q_edge = isEdge(q);
    bool swap = p_edge == q_edge ? (p_edge ? !edgeBefore(p, q) : !refBefore(p.ref, q.ref)) : !p_edge;
    Carrier first = p, second = q;
    if (swap) {
        first = q;
        second = p;
    }
    if (p_edge && q_edge) return crossEdges(first, second, point);
    if (p_edge || q_edge) return crossEdgeWithDepth(first, second, point);
    return crossDepths(first, second, point);
}

bool meet(uint i, uint j) {
    GpuLine p = lines[lineAt(i)], q = lines[lineAt(j)];
    FinePoint point;
    if (meetInVertex(p, q) || !crossing(carrierFrom(p), carrierFrom(q), point)) return true;
    OrderKey key = keyIn(frame, yOf(point));
    if (keyLess(key, keyFrom(p.in0)) || keyLess(key, keyFrom(q.in0))) return true;
    if (keyLess(keyFrom(p.in1), key) || keyLess(keyFrom(q.in1), key)) return true;
    return addEvent(key, i, j, point);
}

void main() {
    if (!openLeaf()) return;
    uint count = candidates();
    bool fits = count <= kLeafWords - kWordPairs;
    for (uint k = 0u; fits && k < count; ++k, ++spent) {
        uint both = words[wordAt(kWordPairs + k)];
        fits = meet(both & 255u, both >> 8);
    }
    if (!fits) handBack();
    countLoops();
    leaves[leaf_slot] = leaf;
}
