#version 460
// One invocation an entry of the tiles' lists: it names the pixels of its tile that it may touch.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/weight_buffers.glsl"
#include "shared/weight_pairs.glsl"

void main() {
    if (flatIndex() >= push.count) return;
    uint entry = push.first + flatIndex(), at = pair_first[entry] - push.pairs_before;
    uint tile_row = (entries[entry].tile - push.first_tile) / push.list_columns;
    uint tile_column = (entries[entry].tile - push.first_tile) % push.list_columns;
    uint first_pixel = (tile_row * push.tile_columns + tile_column) * 64u;
    SeenSegment s = seenFrom(segments[entries[entry].segment], push.offset_x, push.offset_y);
    int x0 = push.x0 + int(tile_column) * kTilePx, y0 = push.y0 + int(tile_row) * kTilePx;
    for (int row = 0; row < kTilePx; ++row) {
        TileSpan columns = pixelsNear(s, x0, y0, row, push.reach);
        for (int column = columns.first; column <= columns.last; ++column)
            pairs[at++] = GpuPair(entry, first_pixel + uint(row * kTilePx + column));
    }
}
