#version 460
// Triangles whose box is 2 x 2 cells at most need no rasterizer: they are counted here. The others are listed.
layout(local_size_x = 64) in;
#include "shared/gather_buffers.glsl"
#include "shared/gather_cells.glsl"
layout(std430, binding = kGatherDirect) writeonly buffer Direct { uint direct[]; };
layout(std430, binding = kGatherWide) writeonly buffer Wide { uint wide[]; };
layout(std430, binding = kGatherDraw) buffer DrawCommand { uint draw[4]; };

layout(constant_id = 0) const int kCounter = 0;  // of the command's words: what grows with each wide triangle
layout(constant_id = 1) const uint kStep = 1;    // by how much

/// Of the box's cells, bit by bit in rows of two: those that the triangle may meet.
uint metCells(uint triangle, CellBox cells) {
    uint met = 0;
    for (int i = 0; i < 4; ++i) {
        ivec2 at = cells.first + ivec2(i & 1, i >> 1);
        if (all(lessThanEqual(at, cells.last)) && meetsCell(triangle, at)) met |= 1u << i;
    }
    return met;
}

void main() {
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= grid.count) return;
    CellBox cells = cellsOf(triangle);
    ivec2 more = cells.last - cells.first;
    uint found = 0;
    if (any(lessThan(more, ivec2(0)))) {
    } else if (any(greaterThan(more, ivec2(1)))) {
        wide[atomicAdd(draw[kCounter], kStep) / kStep] = triangle;
    } else {
        uint met = more == ivec2(0) ? 1 : metCells(triangle, cells);
        uint cell = uint(cells.first.y * grid.columns + cells.first.x);
        for (int i = 0; i < 4; ++i)
            if ((met >> i & 1) != 0) atomicAdd(histogram[directCell(cell, i)], 1);
        found = cell << 4 | met;
    }
    direct[triangle] = found;
}
