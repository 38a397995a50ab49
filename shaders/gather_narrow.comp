#version 460
// The triangles that meet one cell at most need no rasterizer: they are counted here. The others are listed.
layout(local_size_x = 64) in;
#include "shared/gather_buffers.glsl"
#include "shared/gather_cells.glsl"
layout(std430, binding = kGatherDirect) writeonly buffer Direct { uint cell_of[]; };
layout(std430, binding = kGatherWide) writeonly buffer Wide { uint wide[]; };
layout(std430, binding = kGatherDraw) buffer DrawCommand { uint draw[4]; };

layout(constant_id = 0) const int kCounter = 0;   // of the command's words: what grows with each wide triangle
layout(constant_id = 1) const uint kStep = 1;     // by how much

void main() {
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= grid.count) return;
    CellBox cells = cellsOf(triangle);
    uint cell = kNoCell;
    if (any(greaterThan(cells.first, cells.last))) {
    } else if (cells.first == cells.last) {
        cell = uint(cells.first.y * grid.columns + cells.first.x);
        atomicAdd(histogram[cell], 1);
    } else {
        wide[atomicAdd(draw[kCounter], kStep) / kStep] = triangle;
    }
    cell_of[triangle] = cell;
}
