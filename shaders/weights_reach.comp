#version 460
// One invocation a segment: it counts in every tile that it may touch, or lists itself there, and the owners on its two
// sides. A segment within one owner is no border: nothing.
#include "shared/weight_list_buffers.glsl"
#include "shared/segment_tiles.glsl"
layout(constant_id = 0) const bool kFill = false;

/// The histogram says how many places of a list are still free.
void meetTile(uint tile, uint id) {
    if (!kFill) {
        atomicAdd(histogram[tile], 2u);
        return;
    }
    uint at = offsets[tile] + atomicAdd(histogram[tile], 0xfffffffeu) - 2u;
    uint left = segments[id].left, right = segments[id].right;
    entries[at / 2u] = GpuTileSegment(id, left, right);
    sides[at] = left;
    sides[at + 1u] = right;
}

void main() {
    uint id = groupIndex() * 64u + gl_LocalInvocationIndex;
    if (id >= push.segments || segments[id].left == segments[id].right) return;
    double ax = (segments[id].a_grid[0] + segments[id].a_rest[0]) - push.offset_x;
    double ay = (segments[id].a_grid[1] + segments[id].a_rest[1]) - push.offset_y;
    double bx = (segments[id].b_grid[0] + segments[id].b_rest[0]) - push.offset_x;
    double by = (segments[id].b_grid[1] + segments[id].b_rest[1]) - push.offset_y;
    TileSpan rows = tileSpan(ay - push.reach, by + push.reach, push.y0, kTilePx, int(push.rows));
    for (int row = rows.first; row <= rows.last; ++row) {
        double y0 = double(push.y0 + row * kTilePx);
        Span x = spanWithin(ax, ay, bx, by, y0 - push.reach, (y0 + double(kTilePx)) + push.reach);
        if (x.low > x.high) continue;
        TileSpan columns = tileSpan(x.low - push.reach, x.high + push.reach, push.x0, kTilePx, int(push.columns));
        for (int column = columns.first; column <= columns.last; ++column)
            meetTile(uint(row) * push.columns + uint(column), id);
    }
}
