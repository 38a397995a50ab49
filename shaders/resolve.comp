#version 460
// One invocation a pixel that sees several owners: the owners of the samples around it that the filter reaches, in
// ascending order, and the sum of each one's weights, into lists in no order of pixels. Weights are fixed point: sums
// are exact in any order, so a pixel of the window whose samples have one owner is added as a whole.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/layouts.glsl"
layout(local_size_x = kResolveGroup) in;
#define bits64 int64_t
#include "shared/resolve.glsl"

layout(constant_id = 0) const uint kMostTurns = 0u;  // of the loops of add()

layout(std430, binding = kResolveSamples) readonly buffer Samples { uint samples[]; };
layout(std430, binding = kResolveUniform) readonly buffer Uniform { uint uniform_owner[]; };
layout(std430, binding = kResolveWeights) readonly buffer Weights { int64_t weights[]; };
layout(std430, binding = kResolvePixelWeights) readonly buffer PixelWeights { int64_t pixel_weights[]; };
layout(std430, binding = kResolvePlaces) readonly buffer Places { WalkPlace places[]; };
layout(std430, binding = kResolveCounts) writeonly buffer Counts { uint counts[]; };
layout(std430, binding = kResolveStatus) buffer Status { ResolveStatus status; };
layout(std430, binding = kResolveFirst) writeonly buffer First { uint first_entry[]; };
layout(std430, binding = kResolveMixed) readonly buffer Mixed { uint mixed_pixels[]; };
layout(std430, binding = kResolveOwners) writeonly buffer Owners { uint entry_owner[]; };
layout(std430, binding = kResolveEntryWeights) writeonly buffer EntryWeights { int64_t entry_weight[]; };
layout(push_constant) uniform Push { ResolvePush push; };

layout(constant_id = 1) const uint kSlots = 1u;  // owners that an invocation holds

// In shared memory, though none is shared: registers are not indexed on most devices.
shared uint slot_owner[kSlots * kResolveGroup];
shared int64_t slot_weight[kSlots * kResolveGroup];
uint slotAt(uint k) { return k * kResolveGroup + gl_LocalInvocationIndex; }

uint found = 0u, last = 0u, turns = 0u;
bool too_much = false;

uint firstNotBelow(uint owner) {
    uint low = 0u, high = found;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (slot_owner[slotAt(middle)] < owner)
            low = middle + 1u;
        else
            high = middle;
        ++turns;
    }
    return low;
}

void insertAt(uint slot, uint owner) {
    for (uint k = found; k > slot; --k) {
        slot_owner[slotAt(k)] = slot_owner[slotAt(k - 1u)], slot_weight[slotAt(k)] = slot_weight[slotAt(k - 1u)];
        ++turns;
    }
    slot_owner[slotAt(slot)] = owner, slot_weight[slotAt(slot)] = int64_t(0);
    ++found;
}

void add(uint owner, int64_t weight) {
    if (found == 0u || slot_owner[slotAt(last)] != owner) {
        // a binary search, and a shift of all slots
        if (turns + kSlots + 8u > kMostTurns) {
            too_much = true;
            return;
        }
        last = firstNotBelow(owner);
        if (last == found || slot_owner[slotAt(last)] != owner) {
            if (found == kSlots) {
                too_much = true;
                return;
            }
            insertAt(last, owner);
        }
    }
    slot_weight[slotAt(last)] += weight;
}

/// What comes next on the walk over the window: a pixel as a whole, or a sample.
struct Step {
    uint owner;
    int64_t weight;
    uint steps;
};

Step stepAt(uint k, uvec2 pixel) {
    WalkPlace place = places[k];
    uint owner = kMixedPixel;
    if (place.pixel_x != kInsidePixel)
        owner = uniform_owner[(pixel.y + place.pixel_y) * push.window_width + pixel.x + place.pixel_x];
    if (owner != kMixedPixel) return Step(owner, pixel_weights[k], push.rows * push.columns);
    uint row = pixel.y * push.rows + place.y, column = pixel.x * push.columns + place.x;
    return Step(samples[row * push.window_width * push.columns + column], weights[k], 1u);
}

/// From step k on: adds up the weights of the first owner that is met, until another one is. Invocations meet their
/// ends at different steps, but look for slots together.
uint addRun(uint k, uint end, uvec2 pixel) {
    bool any = false;
    uint owner = 0u;
    int64_t weight = int64_t(0);
    while (k < end) {
        Step next = stepAt(k, pixel);
        bool reached = next.weight != kUnreached;
        if (reached && any && next.owner != owner) break;
        if (reached) owner = next.owner, weight += next.weight, any = true;
        k += next.steps;
    }
    if (any) add(owner, weight);
    return k;
}

void main() {
    uint turn = (gl_WorkGroupID.y * push.row) + gl_GlobalInvocationID.x;
    if (turn >= status.mixed) return;
    uint at = mixed_pixels[turn], side = 2u * push.margin + 1u, end = side * side * push.rows * push.columns;
    uvec2 pixel = uvec2(at % push.width, at / push.width);
    for (uint k = 0u; k < end && !too_much;) k = addRun(k, end, pixel);
    if (too_much) {
        counts[at] = first_entry[at] = kHandedBack;
        atomicAdd(status.handed_back, 1u);
        return;
    }
    uint first = atomicAdd(status.entries, found);
    counts[at] = found, first_entry[at] = first;
    if (first + found > push.room) return;  // the host sees that entries do not fit
    for (uint k = 0u; k < found; ++k)
        entry_owner[first + k] = slot_owner[slotAt(k)], entry_weight[first + k] = slot_weight[slotAt(k)];
}
