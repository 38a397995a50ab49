#version 460
// Cells that are neither empty nor certified: the crowded are split, the others are leaves.
layout(local_size_x = 64) in;
#include "shared/visibility_buffers.glsl"

void main() {
    if (gl_GlobalInvocationID.x >= push.count) return;
    uint id = push.first + gl_GlobalInvocationID.x;
    GpuCell c = cells[id];
    if (c.state != kCellOpen) return;
    if (!(c.count - c.panes > push.max_triangles && c.size_px > push.min_cell_px)) {
        leaf_cells[atomicAdd(status.leaves, 1u)] = id;
        return;
    }
    uint child = atomicAdd(status.cells, 4u), room = atomicAdd(status.kept, 4u * c.count);
    cells[id].state = kCellSplit;
    if (child + 4u > status.cells_room || room + 4u * c.count > status.kept_room) return;
    double half_px = 0.5lf * c.size_px;
    for (uint k = 0u; k < 4u; ++k)
        cells[child + k] = GpuCell(c.min_x + ((k & 1u) != 0u ? half_px : 0.0lf), c.min_y + ((k & 2u) != 0u ? half_px : 0.0lf),
                                   half_px, c.origin_x, c.origin_y, c.begin, room + k * c.count, c.count, 0u, kCellOpen, 0u);
}
