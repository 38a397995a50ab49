#version 460
// The cells of the lattice, with their candidates as gather lists them.
layout(local_size_x = 64) in;
#include "shared/visibility_buffers.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    double x = double(push.x0_px + 16 * int(i % uint(push.columns)));
    double y = double(push.y0_px + 16 * int(i / uint(push.columns)));
    uint begin = offsets[i];
    cells[i] = GpuCell(x, y, 16.0lf, x, y, begin, begin, offsets[i + 1] - begin, 0u, kCellOpen, 0u);
}
