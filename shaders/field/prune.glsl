// One invocation a tile and coarse segment of its depths: the rows that count in the ball around all its rays there, then
// which of those count in the fine segments.
uint ew_place[ew_batches], ew_room[ew_batches];  // of the lists that are being made

void ew_forget(uint batch) { ew_items[ew_place[batch]] = 0u; }
void ew_keep(uint batch, uint row) {
    uint at = ew_place[batch], count = ew_items[at];
    if (count == ew_too_long) return;
    if (count == ew_room[batch]) {
        ew_items[at] = ew_too_long;
        return;
    }
    ew_items[at + 1u + count] = row;
    ew_items[at] = count + 1u;
}
