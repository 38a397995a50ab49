#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// The lines of a leaf where two of its planes are equal: analytic/leaf_lines.cpp, addDepthLines().
layout(local_size_x = 64) in;
#include "shared/visibility_buffers.glsl"
#include "shared/visibility_int64.glsl"
#include "shared/line_key.glsl"
#include "shared/visibility_leaf.glsl"
#include "shared/visibility_new_line.glsl"

/// Pairs that may change order in the cell, as i + 256 j.
uint candidatePairs() {
    dvec2 lo = frame.cell.min - frame.origin;
    dvec2 hi = frame.cell.max - frame.origin + dvec2(1.1641532182693481e-10lf, 1.1641532182693481e-10lf);
    uint begin = cells[leaf.cell].begin, count = 0u;
    bool every = (push.flags & kEveryDepthLine) != 0;
    for (uint i = 0u; i < leaf.triangles; ++i, spent += 2u) {
        LocalPlane p = localPlaneAt(i);
        for (uint j = i + 1u; j < leaf.triangles; ++j, ++spent) {
            LocalPlane q = localPlaneAt(j);
            if (p.plane == q.plane || p.owner == q.owner) continue;
            if (!every && ordered(p, q, lo, hi)) continue;
            words[wordAt(kWordPairs + count++)] = i + 256u * j;
        }
    }
    return count;
}

/// Whether two planes may change order in what their triangles have in common within the cell.
bool changesOrder(uint i, uint j) {
    uint begin = cells[leaf.cell].begin;
    ScreenTriangle s = triangleAt(kept[begin + i]), t = triangleAt(kept[begin + j]);
    LocalPlane p = localPlaneAt(i), q = localPlaneAt(j);
    if (!boxesOverlap(s, t) || separates(s, t) || separates(t, s)) return false;
    if (signsAtVertices(s, p, q, frame.origin) != 3 || signsAtVertices(t, p, q, frame.origin) != 3) return false;
    dvec2 lo = frame.cell.min - frame.origin;
    dvec2 hi = frame.cell.max - frame.origin + dvec2(1.1641532182693481e-10lf, 1.1641532182693481e-10lf);
    return signsOver(commonPart(s, t, frame.origin, lo, hi), p, q) == 3;
}

bool addFlat(LeafLine line) {
    FineCoordinate y = yOf(pointAtX(line.carrier, border(frame.cell.min.x)));
    if (keyEqual(keyIn(frame, y), frame.bottom)) y.rest -= 1.3234889800848443e-23lf;  // on the border: this cell's
    OrderKey key = keyIn(frame, y);
    if (!keyLess(frame.top, key) || !keyLess(key, frame.bottom)) return true;
    if (leaf.horizontals >= kLeafHorizontals) return false;
    line.in0 = key;
    line.enter = finePoint(border(frame.cell.min.x), y);
    line.exit = finePoint(border(frame.cell.max.x), y);
    horizontals[horizontalAt(leaf.horizontals++)] = newLine(line, 0u);
    return true;
}

bool addPair(uint i, uint j, uint first_line, uint first_flat) {
    if ((push.flags & kEveryDepthLine) == 0 && !changesOrder(i, j)) return true;
    LeafLine line = emptyLine(depthLineOf(localPlaneAt(i).plane, localPlaneAt(j).plane));
    Carrier c = line.carrier;
    if (c.A.hi == 0.0lf && c.B.hi == 0.0lf) return true;
    for (uint l = first_line; l < leaf.lines; ++l, ++spent)
        if (LineRef(lines[lineAt(l)].line_i, lines[lineAt(l)].line_j) == c.ref) return true;
    for (uint h = first_flat; h < leaf.horizontals; ++h, ++spent)
        if (LineRef(horizontals[horizontalAt(h)].line_i, horizontals[horizontalAt(h)].line_j) == c.ref) return true;
    if (isHorizontal(c)) return addFlat(line);
    if (!clipDepthLine(frame, line)) return true;
    if (leaf.lines >= kLeafLines) return false;
    lines[lineAt(leaf.lines++)] = newLine(line, 0u);
    return true;
}

void main() {
    if (!openLeaf()) return;
    uint count = candidatePairs(), first_line = leaf.lines, first_flat = leaf.horizontals;
    bool fits = true;
    for (uint k = 0u; fits && k < count; ++k, spent += 30u) {
        uint both = words[wordAt(kWordPairs + k)];
        fits = addPair(both & 255u, both >> 8, first_line, first_flat);
    }
    leaf.depth_lines = leaf.lines + leaf.horizontals - first_line - first_flat;
    if (!fits) handBack();
    countLoops();
    leaves[leaf_slot] = leaf;
}
