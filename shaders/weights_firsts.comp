#version 460
// One workgroup a tile: of the owners on its segments' sides, sorted, which are the first of their name.
#include "shared/weight_list_buffers.glsl"

void main() {
    if (groupIndex() >= tileCount()) return;
    uint begin = offsets[groupIndex()], end = offsets[groupIndex() + 1u];
    for (uint i = begin + gl_LocalInvocationIndex; i < end; i += 64u)
        firsts[i] = i == begin || sides[i] != sides[i - 1u] ? 1u : 0u;
}
