// Lists of a batch's rows. ew_items begins with every row of every batch; then, for each tile and segment of its depths,
// and each batch, a count and so many rows, in the batch's order. A list that would be too long is marked, and all rows
// count there.
const uint ew_too_long = 0xffffffffu;

void ew_allRows() {
    for (uint b = 0u; b < ew_batches; ++b) ew_range[b] = uvec2(ew_all_begin[b], ew_all_begin[b + 1u]);
}
uint ew_listAt(uint tile, uint segment, uint batch) {
    return ew_all_begin[ew_batches] + (tile * ew_segments + segment) * ew_list_stride + ew_list_begin[batch];
}
/// Those of the tile at depth t.
void ew_rowsAt(uint tile, float t) {
    ew_allRows();
    if (ew_pruned == 0u) return;
    float begin = ew_tiles[tile].list_begin, end = ew_tiles[tile].list_end;
    if (!(t >= begin && t < end)) return;
    uint segment = min(uint((t - begin) / (end - begin) * float(ew_segments)), ew_segments - 1u);
    for (uint b = 0u; b < ew_batches; ++b) {
        uint at = ew_listAt(tile, segment, b), count = ew_items[at];
        if (count != ew_too_long) ew_range[b] = uvec2(at + 1u, at + 1u + count);
    }
}
