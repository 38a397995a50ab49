// One invocation a tile and segment of its depths: the rows that count in the ball around all its rays there.
uint ew_list_of = 0u, ew_segment_of = 0u;

void ew_forget(uint batch) { ew_items[ew_listAt(ew_list_of, ew_segment_of, batch)] = 0u; }
void ew_keep(uint batch, uint row) {
    uint at = ew_listAt(ew_list_of, ew_segment_of, batch), count = ew_items[at];
    if (count == ew_too_long) return;
    if (count == ew_list_capacity[batch]) {
        ew_items[at] = ew_too_long;
        return;
    }
    ew_items[at + 1u + count] = row;
    ew_items[at] = count + 1u;
}
