#version 460
// A cell keeps the candidates that meet it and that no opaque triangle hides there: analytic/cell_visibility.cpp,
// collect(). Empty cells are the background's, at once.
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const bool kRoots = true;  // candidates come from gather's lists, not from a parent
#include "shared/visibility_buffers.glsl"

double depthIn(uint triangle, dvec2 center) {
    return planeOf(triangle, center, 0.0lf).c;
}

/// Drops what the occluder hides; returns how many are left.
uint dropHidden(GpuCell c, uint occluder, uint count) {
    dvec2 low = dvec2(c.min_x, c.min_y), size = dvec2(c.size_px, c.size_px);
    LocalPlane front = planeOf(occluder, low, c.size_px * 1.0625lf);
    uint left = 0u;
    for (uint i = 0u; i < count; ++i) {
        uint index = kept[c.begin + i];
        bool hidden = index != occluder && hidesIn(front, planeOf(index, low, c.size_px * 1.0625lf), size);
        if (!hidden) kept[c.begin + left] = index;
        left += hidden ? 0u : 1u;
    }
    return left;
}

void emptyRows(GpuCell c) {
    Cell cell = cellOf(c);
    for (int row = int(floor(c.min_y - 0.5lf)); double(row) + 0.5lf <= cell.max.y; ++row) {
        if (!(double(row) + 0.5lf > c.min_y)) continue;
        addRow(atomicAdd(status.rows, 1u), c.min_x + border(0.0lf).rest, row, kBackground, kNoTag);
    }
}

void main() {
    if (gl_GlobalInvocationID.x >= push.count) return;
    uint id = push.first + gl_GlobalInvocationID.x;
    GpuCell c = cells[id];
    if (c.count > kCellCandidates) {
        cells[id].untouched = 1u;
        cells[id].state = kCellHanded;
        handed[atomicAdd(status.handed, 1u)] = id;
        return;
    }
    Cell cell = cellOf(c);
    dvec2 center = 0.5lf * (cell.min + cell.max);
    uint count = 0u, panes = 0u, occluder = kNoTag;
    double nearest = 0.0lf;
    bool any_see_through = false;
    for (uint i = 0u; i < c.count; ++i) {
        uint index = kRoots ? ids[c.source + i] : kept[c.source + i];
        dvec2 p = cornerAt(index, 0u), q = cornerAt(index, 1u), r = cornerAt(index, 2u);
        int meets = cellOverlap(p.x, p.y, q.x, q.y, r.x, r.y, cell.min.x, cell.min.y, cell.max.x, cell.max.y);
        if (meets == kMisses) continue;
        kept[c.begin + count++] = index;
        bool pane = seesThrough(triangles[index].owner);
        any_see_through = any_see_through || pane;
        if (meets != kCovers) continue;
        if (pane) {
            ++panes;
            continue;
        }
        double z = depthIn(index, center);
        if (occluder == kNoTag || z > nearest) {
            nearest = z;
            occluder = index;
        }
    }
    if (occluder != kNoTag && (push.flags & kDropHidden) != 0) {
        uint left = dropHidden(c, occluder, count);
        atomicAdd(status.hidden, count - left);
        count = left;
    }
    cells[id].count = count;
    cells[id].panes = min(panes, count);
    if (count == 0u) {
        emptyRows(c);
        cells[id].state = kCellDone;
    } else if (any_see_through) {
        cells[id].state = kCellHanded;
        handed[atomicAdd(status.handed, 1u)] = id;
    }
}
