#version 460
// One workgroup a tile: its owners, once each, and where among them its segments find theirs.
#include "shared/weight_list_buffers.glsl"

uint placeOf(uint owner, uint first, uint last) {
    uint begin = first, end = last;
    while (begin < end) {
        uint middle = (begin + end) / 2u;
        if (sides[middle] < owner)
            begin = middle + 1u;
        else
            end = middle;
    }
    return places[begin] - places[first];
}

void main() {
    uint tile = groupIndex(), lane = gl_LocalInvocationIndex;
    if (tile >= tileCount()) return;
    uint begin = offsets[tile], end = offsets[tile + 1u];
    if (lane == 0u) slots[tile] = places[begin];
    if (lane == 0u && tile + 1u == tileCount()) slots[tile + 1u] = places[end];
    for (uint i = begin + lane; i < end; i += 64u)
        if (places[i + 1u] > places[i]) owners[places[i]] = sides[i];
    for (uint e = begin / 2u + lane; e < end / 2u; e += 64u) {
        entries[e].left = placeOf(entries[e].left, begin, end);
        entries[e].right = placeOf(entries[e].right, begin, end);
    }
}
