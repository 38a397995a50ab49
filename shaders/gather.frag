#version 460
// A fragment is a cell that a triangle may meet: asked exactly, then counted, or filled into the cell's list.
#include "shared/gather_buffers.glsl"
#include "shared/gather_cells.glsl"
layout(std430, binding = kGatherOffsets) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = kGatherIds) writeonly buffer Ids { uint ids[]; };

layout(constant_id = 0) const bool kFill = false;
layout(location = 0) flat in uint triangle;
layout(location = 1) flat in ivec4 cells;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    // the box that the paper clips thickened triangles to
    if (any(lessThan(at, cells.xy)) || any(greaterThan(at, cells.zw)) || !meetsCell(triangle, at)) return;
    uint cell = uint(at.y * grid.columns + at.x);
    if (!kFill) {
        atomicAdd(histogram[cell], 1);
        return;
    }
    uint left = atomicAdd(histogram[cell], 0xffffffffu);
    ids[offsets[cell] + left - 1] = triangle;
}
