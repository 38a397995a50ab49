#version 460
// The owner of the border where nothing crosses it, or before what crosses it first, makes a pixel's sums complete;
// entries are counted. What is not certain here is left to the host: analytic/border.cpp sorts crossings for it. [E12]-[E15]
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/weight_buffers.glsl"
layout(constant_id = 0) const bool kCircle = true;  // the border closes, order is in turns
layout(constant_id = 1) const uint kMostOwners = 0xffffffffu;  // that a loop of the device may ask

/// As ownersAlongRow() finds it: the last entry that begins at x or before, or the row's first.
uint ownerOnRow(int row, double x) {
    uint first = row_offsets[row - push.row_begin], begin = first, end = row_offsets[row - push.row_begin + 1];
    while (begin < end) {
        uint middle = (begin + end) / 2u;
        if (x < rows[middle].x_px)
            end = middle;
        else
            begin = middle + 1u;
    }
    return rows[max(begin, first + 1u) - 1u].owner;
}

/// Its place among the tile's owners; their number where it is none of them.
uint placeOf(uint owner) {
    uint begin = 0u, end = ownerCount();
    while (begin < end) {
        uint middle = (begin + end) / 2u;
        if (ownerAt(middle) < owner)
            begin = middle + 1u;
        else
            end = middle;
    }
    return begin < ownerCount() && ownerAt(begin) == owner ? begin : ownerCount();
}

uint baseOwner(GpuPixelState state) {
    if (state.base_distance2 < 1e300lf) return state.base_owner;
    return ownerOnRow(push.y0 + pixelInBox().y + int(push.offset_y), sampleX() + push.radius);
}

/// Whether the crossings leave every owner as often as they enter it, but for the first owner and the last.
bool isBalanced(GpuPixelState state) {
    uint64_t balance = packUint2x32(uvec2(state.balance_low, state.balance_high));
    if (kCircle) return balance == 0ul;
    return balance == hashOf(ownerAt(state.first_owner)) - hashOf(ownerAt(state.last_owner));
}

/// Whether rounding cannot have moved another crossing before the first; along a side, behind the last.
bool isOrdered(GpuPixelState state) {
    bool first = state.first_high < state.next_low;
    if (kCircle) return first && state.first_low > -0.5lf && state.last_high < 0.5lf;
    return first && state.last_low > state.before_high;
}

uint entriesOf() {
    uint count = 0u;
    for (uint place = 0u; place < ownerCount(); ++place) count += sums[sumIndex(place)] != 0l ? 1u : 0u;
    return count;
}

void main() {
    if (!hasPixel()) return;
    GpuPixelState state = states[stateIndex()];
    uint place = kCircle ? state.first_owner : state.last_owner;
    uint owner = 0u, kind = kPixelSums;
    if (state.crossings == 0u) {
        owner = baseOwner(state);
        place = state.touched == 0u ? 0u : placeOf(owner);
        if (state.touched == 0u) kind = kPixelWhole;
        else if (place == ownerCount()) kind = kPixelHanded;
    } else if (!isOrdered(state) || !isBalanced(state)) {
        kind = kPixelHanded;
    }
    if (ownerCount() > kMostOwners && kind == kPixelSums) kind = kPixelHanded;
    if (kind == kPixelSums) sums[sumIndex(place)] += 1l << 60;
    pixels[stateIndex()] = uvec2(kind, owner);
    atomicAdd(status.terms, state.touched);
    if (kind == kPixelWhole) atomicAdd(status.whole, 1u);
    if (kind == kPixelHanded) handed[atomicAdd(status.handed, 1u)] = pixelIndex();
    counts[pixelIndex()] = kind == kPixelSums ? entriesOf() : kind == kPixelWhole ? 1u : 0u;
}
