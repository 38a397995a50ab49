#version 460
// A wide triangle becomes a box of cells, each of whose pixels' centres lies half a pixel inside: nothing that
// the rasterizer rounds can lose one. Two triangles a box; or the geometry shader does better.
#include "shared/gather_buffers.glsl"
#include "shared/gather_cells.glsl"
layout(std430, binding = kGatherWide) readonly buffer Wide { uint wide[]; };

layout(constant_id = 1) const int kForm = 0;  // 0: a list of six vertices a box, 1: an instance a box
layout(location = 0) flat out uint triangle;
layout(location = 1) flat out ivec4 cells;

void main() {
    int box = kForm == 0 ? gl_VertexIndex / 6 : gl_InstanceIndex;
    int corner = kForm == 0 ? gl_VertexIndex % 6 : gl_VertexIndex;
    if (kForm == 0 && corner >= 3) corner = corner - 2;  // 0 1 2, 1 2 3
    triangle = wide[box];
    CellBox found = cellsOf(triangle);
    cells = ivec4(found.first, found.last);
    gl_Position = clipPosition(dvec2((corner & 1) == 0 ? cells.x : cells.z + 1,
                                     (corner & 2) == 0 ? cells.y : cells.w + 1));
}
