#version 460
// One invocation an entry of the tiles' lists: it names the pixels of its tile that it may touch.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/weight_buffers.glsl"
#include "shared/weight_pairs.glsl"

void main() {
    if (flatIndex() >= push.count) return;
    uint at = pair_first[push.first + flatIndex()] - push.pairs_before;
    GpuTileSegment entry = entries[push.first + flatIndex()];
    uint tile_row = (entry.tile - push.first_tile) / push.list_columns;
    uint tile_column = (entry.tile - push.first_tile) % push.list_columns;
    uint tile = tile_row * push.tile_columns + tile_column, sums = sum_first[tile];
    SeenSegment s = seenFrom(segments[entry.segment], push.offset_x, push.offset_y);
    int x0 = push.x0 + int(tile_column) * kTilePx, y0 = push.y0 + int(tile_row) * kTilePx;
    for (int row = 0; row < kTilePx; ++row) {
        TileSpan columns = pixelsNear(s, x0, y0, row, push.reach);
        for (int column = columns.first; column <= columns.last; ++column)
            
            pairs[at++] =
                GpuPair(entry.segment, entry.left, entry.right, tile * 64u + uint(row * kTilePx + column), sums);
    }
}
