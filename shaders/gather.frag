#version 460
// A fragment is a cell that a triangle may meet: asked exactly, then counted, or filled into the cell's list.
#include "shared/gather_buffers.glsl"
layout(std430, binding = kGatherOffsets) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = kGatherIds) writeonly buffer Ids { uint ids[]; };

layout(constant_id = 0) const bool kFill = false;
layout(location = 0) flat in uint triangle;
layout(location = 1) flat in ivec4 cells;

bool meets(ivec2 at) {
    double x0 = double(grid.x0_px + 16 * at.x), y0 = double(grid.y0_px + 16 * at.y);
    return cellOverlap(triangles[triangle].p_px[0], triangles[triangle].p_px[1], triangles[triangle].p_px[2],
                       triangles[triangle].p_px[3], triangles[triangle].p_px[4], triangles[triangle].p_px[5],
                       x0, y0, x0 + 16.0, y0 + 16.0) != kMisses;
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    // the box that the paper clips thickened triangles to
    if (any(lessThan(at, cells.xy)) || any(greaterThan(at, cells.zw)) || !meets(at)) return;
    uint cell = uint(at.y * grid.columns + at.x);
    if (!kFill) {
        atomicAdd(histogram[cell], 1);
        return;
    }
    uint left = atomicAdd(histogram[cell], 0xffffffffu);
    ids[offsets[cell] + left - 1] = triangle;
}
