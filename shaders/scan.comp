#version 460
// Prefix sums of counts, block by block: reduce gives the sum of every block, scan the sums before every item
// of a block, starting from the scanned sums of the blocks before it. Sums that 32 bits do not hold stay at
// their largest value: saturating addition is associative too.
layout(local_size_x = 128) in;
#include "shared/layouts.glsl"
layout(constant_id = 0) const bool kReduce = false;
layout(constant_id = 1) const bool kBased = false;  // there are blocks before: their sums are given
layout(std430, binding = 0) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 1) readonly buffer Before { uint before[]; };
layout(std430, binding = 2) writeonly buffer Sums { uint sums[]; };
layout(push_constant) uniform Push { uint count; };

shared uint part[128];

uint plus(uint a, uint b) { return a + b < a ? 0xffffffffu : a + b; }

/// part[i] = part[0] + ... + part[i] (Hillis, Steele 1986).
void scanParts(uint i) {
    for (uint step = 1; step < 128; step *= 2) {
        barrier();
        uint sum = i >= step ? plus(part[i - step], part[i]) : part[i];
        barrier();
        part[i] = sum;
    }
    barrier();
}

void main() {
    uint lane = gl_LocalInvocationID.x, first = gl_WorkGroupID.x * kScanBlock + lane * kScanItems;
    uint last = min(first + kScanItems, count), sum = 0;
    for (uint i = first; i < last; ++i) sum = plus(sum, counts[i]);
    part[lane] = sum;
    scanParts(lane);
    if (kReduce) {
        if (lane == 127) sums[gl_WorkGroupID.x] = part[lane];
        return;
    }
    uint running = kBased ? before[gl_WorkGroupID.x] : 0;
    if (lane > 0) running = plus(running, part[lane - 1]);
    for (uint i = first; i < last; ++i) {
        sums[i] = running;
        running = plus(running, counts[i]);
    }
    if ((first < count && last == count) || (count == 0 && lane == 0)) sums[count] = running;
}
