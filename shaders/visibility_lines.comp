#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// The planes and edges of a leaf, clipped to it: analytic/leaf_lines.cpp, addEdge().
layout(local_size_x = 64) in;
#include "shared/visibility_buffers.glsl"
#include "shared/visibility_int64.glsl"
#include "shared/line_key.glsl"
#include "shared/visibility_leaf.glsl"
#include "shared/visibility_new_line.glsl"

/// The line of the same edge, or the number of lines.
uint knownEdge(Carrier edge) {
    for (uint i = 0u; i < leaf.lines; ++i)
        if (pair(lines[lineAt(i)].a) == edge.a && pair(lines[lineAt(i)].b) == edge.b) return i;
    return leaf.lines;
}

bool addEdge(uint triangle, uint k, uint bit) {
    LeafLine line = emptyLine(edgeAt(triangle, k));
    bool flat_edge = isHorizontal(line.carrier), found;
    if (flat_edge) {
        LeafHorizontal h;
        found = clipHorizontalEdge(frame, line.carrier, h);
        line.in0 = h.key;
        line.enter = h.low;
        line.exit = h.high;
        if (!found) return true;
        if (leaf.horizontals >= kLeafHorizontals) return false;
        horizontals[horizontalAt(leaf.horizontals++)] = newLine(line, 0u);
        return true;
    }
    uint known = knownEdge(line.carrier);
    if (known < leaf.lines) {
        lines[lineAt(known)].bounds ^= 1u << bit;
        LineRef ref = LineRef(lines[lineAt(known)].line_i, lines[lineAt(known)].line_j);
        if (refBefore(line.carrier.ref, ref)) {
            lines[lineAt(known)].line_i = line.carrier.ref.i;
            lines[lineAt(known)].line_j = line.carrier.ref.j;
        }
        return true;
    }
    if (!clipEdge(frame, line)) return true;
    if (leaf.lines >= kLeafLines) return false;
    lines[lineAt(leaf.lines++)] = newLine(line, 1u << bit);
    return true;
}

void main() {
    leaf_slot = gl_GlobalInvocationID.x;
    if (leaf_slot >= push.count) return;
    uint id = leaf_cells[push.first + leaf_slot];
    GpuCell c = cells[id];
    leaf = GpuLeaf(id, kLeafRuns, 0u, c.count, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, kBackground, 0u, 0u, 0u, 0u, 0u);
    frame = frameOf(c);
    if (c.count > kLeafTriangles) {
        handBack();
    } else {
        double reach = max(frame.cell.max.x - frame.origin.x, frame.cell.max.y - frame.origin.y) + 1.0lf;
        for (uint i = 0u; i < c.count; ++i) {
            LocalPlane p = planeOf(kept[c.begin + i], frame.origin, reach);
            local_planes[planeSlot(i)] = GpuLocalPlane(p.a, p.b, p.c, p.error, p.plane, p.owner);
        }
        bool fits = true;
        for (uint i = 0u; fits && i < 3u * c.count; ++i) fits = addEdge(kept[c.begin + i / 3u], i % 3u, i / 3u);
        if (!fits) handBack();
    }
    leaves[leaf_slot] = leaf;
}
