// Lists of a batch's rows. ew_items begins with every row of every batch; then, for each tile, the lists of ew_segments
// fine segments of its depths, and those of ew_coarse coarse ones, which the fine ones are made from. A list is a count
// and so many rows, in the batch's order. One that would be too long is marked, and all rows count there.
const uint ew_too_long = 0xffffffffu;

void ew_allRows() {
    for (uint b = 0u; b < ew_batches; ++b) ew_range[b] = uvec2(ew_all_begin[b], ew_all_begin[b + 1u]);
}
uint ew_fineAt(uint tile, uint segment, uint batch) {
    return ew_all_begin[ew_batches] + tile * ew_tile_stride + segment * ew_fine_stride + ew_fine_begin[batch];
}
uint ew_coarseAt(uint tile, uint segment, uint batch) {
    return ew_all_begin[ew_batches] + tile * ew_tile_stride + ew_segments * ew_fine_stride + segment * ew_coarse_stride +
           ew_coarse_begin[batch];
}
/// Those of the tile at depth t.
void ew_rowsAt(uint tile, float t) {
    ew_allRows();
    if (ew_pruned == 0u) return;
    float begin = ew_tiles[tile].list_begin, end = ew_tiles[tile].list_end;
    if (!(t >= begin && t < end)) return;
    uint segment = min(uint((t - begin) / (end - begin) * float(ew_segments)), ew_segments - 1u);
    for (uint b = 0u; b < ew_batches; ++b) {
        uint at = ew_fineAt(tile, segment, b), count = ew_items[at];
        if (count != ew_too_long) ew_range[b] = uvec2(at + 1u, at + 1u + count);
    }
}
