#version 460
// One invocation a segment: it counts in every tile that it may touch, or lists itself there, the owners on its two
// sides, and how many of the tile's pixels it may touch. A segment within one owner is no border: nothing.
#include "shared/weight_list_buffers.glsl"
#include "shared/weight_pairs.glsl"
layout(constant_id = 0) const bool kFill = false;

/// The histogram says how many places of a list are still free.
void meetTile(uint row, uint column, uint id, SeenSegment s) {
    uint tile = row * push.columns + column;
    if (!kFill) {
        atomicAdd(histogram[tile], 2u);
        return;
    }
    uint at = offsets[tile] + atomicAdd(histogram[tile], 0xfffffffeu) - 2u;
    uint left = segments[id].left, right = segments[id].right;
    entries[at / 2u] = GpuTileSegment(id, left, right, tile);
    sides[at] = left;
    sides[at + 1u] = right;
    pair_counts[at / 2u] = pairsNear(s, push.x0 + int(column) * kTilePx, push.y0 + int(row) * kTilePx, push.reach);
}

void main() {
    uint id = groupIndex() * 64u + gl_LocalInvocationIndex;
    if (id >= push.segments || segments[id].left == segments[id].right) return;
    SeenSegment s = seenFrom(segments[id], push.offset_x, push.offset_y);
    TileSpan rows = tileSpan(s.ay - push.reach, s.by + push.reach, push.y0, kTilePx, int(push.rows));
    for (int row = rows.first; row <= rows.last; ++row) {
        double y0 = double(push.y0 + row * kTilePx);
        Span x = spanWithin(s.ax, s.ay, s.bx, s.by, y0 - push.reach, (y0 + double(kTilePx)) + push.reach);
        if (x.low > x.high) continue;
        TileSpan columns = tileSpan(x.low - push.reach, x.high + push.reach, push.x0, kTilePx, int(push.columns));
        for (int column = columns.first; column <= columns.last; ++column) meetTile(uint(row), uint(column), id, s);
    }
}
