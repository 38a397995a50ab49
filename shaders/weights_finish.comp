#version 460
// The owner of the border where nothing crosses it, or before what crosses it first, makes a pixel's sums complete;
// entries are counted. What is not certain here is left to the host: analytic/border.cpp sorts crossings for it. [E12]-[E15]
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/weight_buffers.glsl"
#include "shared/edge_input.glsl"
#include "shared/base_point.glsl"
layout(constant_id = 0) const bool kCircle = true;  // the border closes, order is in turns
layout(constant_id = 1) const uint kMostOwners = 0xffffffffu;  // that a loop of the device may ask, or notes

/// What a pixel's notes come to.
struct Border {
    uint crossings, first_owner, last_owner;  // places: before the first crossing, after the last
    double first_low, first_high;             // the crossing that comes first on the border: its order -+ doubt
    double next_low;                          // where the next one may begin
    double last_high, last_low, before_high;
    uint64_t balance;  // owners left less owners entered, hashed
    BasePoint base;
    bool complete;
};

void addCrossing(inout Border border, double order, double doubt, uint before, uint after) {
    border.balance += hashOf(ownerAt(before)) - hashOf(ownerAt(after));
    ++border.crossings;
    double low = order - doubt, high = order + doubt;
    if (low < border.first_low) {
        border.next_low = border.first_low;
        border.first_low = low;
        border.first_high = high;
        border.first_owner = before;
    } else {
        border.next_low = min(border.next_low, low);
    }
    if (high > border.last_high) {
        border.before_high = border.last_high;
        border.last_high = high;
        border.last_low = low;
        border.last_owner = after;
    } else {
        border.before_high = max(border.before_high, high);
    }
}

void addNote(inout Border border, GpuBorderNote note) {
    if (note.kind == kNoteEntry) addCrossing(border, note.first, note.second, note.left, note.right);
    if (note.kind == kNoteExit) addCrossing(border, note.first, note.second, note.right, note.left);
    if (note.kind < kNoteBaseLeft) return;
    BasePoint base =
        BasePoint(note.first, note.second, ownerAt(note.kind == kNoteBaseLeft ? note.left : note.right));
    if (isNearer(base, border.base)) border.base = base;
}

Border borderOf(uint first_note) {
    Border border = Border(0u, 0u, 0u, 1e300lf, 1e300lf, 1e300lf, -1e300lf, -1e300lf, -1e300lf, 0ul, noBasePoint(), true);
    uint left = kMostOwners;
    for (uint next = first_note; next != 0u;) {
        if (left-- == 0u) {
            border.complete = false;
            break;
        }
        GpuBorderNote note = notes[next - 1u];
        addNote(border, note);
        next = note.next;
    }
    return border;
}

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

uint baseOwner(Border border) {
    if (isKnown(border.base)) return border.base.owner;
    return ownerOnRow(push.y0 + pixelInBox().y + int(push.offset_y), sampleX() + push.radius);
}

/// Whether the crossings leave every owner as often as they enter it, but for the first owner and the last.
bool isBalanced(Border border) {
    if (kCircle) return border.balance == 0ul;
    return border.balance == hashOf(ownerAt(border.first_owner)) - hashOf(ownerAt(border.last_owner));
}

/// Whether rounding cannot have moved another crossing before the first; along a side, behind the last.
bool isOrdered(Border border) {
    bool first = border.first_high < border.next_low;
    if (kCircle) return first && border.first_low > -0.5lf && border.last_high < 0.5lf;
    return first && border.last_low > border.before_high;
}

uint entriesOf() {
    uint count = 0u;
    for (uint place = 0u; place < ownerCount(); ++place) count += sums[sumIndex(place)] != 0l ? 1u : 0u;
    return count;
}

void main() {
    if (!findPixel()) return;
    GpuPixelState state = states[stateIndex()];
    Border border = borderOf(state.notes);
    uint place = kCircle ? border.first_owner : border.last_owner;
    uint owner = 0u, kind = kPixelSums;
    if (border.crossings == 0u) {
        owner = baseOwner(border);
        place = state.touched == 0u ? 0u : placeOf(owner);
        if (state.touched == 0u) kind = kPixelWhole;
        else if (place == ownerCount()) kind = kPixelHanded;
    } else if (!isOrdered(border) || !isBalanced(border)) {
        kind = kPixelHanded;
    }
    if (!border.complete || (ownerCount() > kMostOwners && kind == kPixelSums)) kind = kPixelHanded;
    if (kind == kPixelSums) sums[sumIndex(place)] += 1l << 60;
    pixels[stateIndex()] = uvec2(kind, owner);
    if (state.touched > 0u) atomicAdd(reports[tile_index].terms, state.touched);
    if (kind == kPixelWhole) atomicAdd(reports[tile_index].whole, 1u);
    if (kind == kPixelHanded) handed[1u + atomicAdd(handed[0], 1u)] = pixelIndex();
    counts[pixelIndex()] = kind == kPixelSums ? entriesOf() : kind == kPixelWhole ? 1u : 0u;
}
