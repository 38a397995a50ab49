#version 460
// Sorts the ids of every list, one invocation a list: pairs, then merges of runs twice as long each, to and fro
// between the ids and as much room behind them. Longer lists than kSortLongest are left to the host: all loops
// of an invocation together may run 65535 times.
layout(local_size_x = 64) in;
#include "shared/layouts.glsl"
layout(std430, binding = 0) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = 1) buffer Ids { uint ids[]; };
layout(push_constant) uniform Push { uint lists; };

void sortPairs(uint from, uint to, uint count) {
    for (uint i = 0; i < count; i += 2) {
        uint a = ids[from + i], b = i + 1 < count ? ids[from + i + 1] : 0xffffffffu;
        ids[to + i] = min(a, b);
        if (i + 1 < count) ids[to + i + 1] = max(a, b);
    }
}

/// The sorted runs of `width` ids become runs of twice that.
void mergeRuns(uint from, uint to, uint count, uint width) {
    uint a = 0, b = min(width, count), a_end = b, b_end = min(2 * width, count);
    for (uint k = 0; k < count; ++k) {
        if (k == b_end) {
            a = k, a_end = min(k + width, count);
            b = a_end, b_end = min(k + 2 * width, count);
        }
        uint left = a < a_end ? ids[from + a] : 0xffffffffu, right = b < b_end ? ids[from + b] : 0xffffffffu;
        bool take_left = left < right || b >= b_end;
        ids[to + k] = take_left ? left : right;
        if (take_left) ++a;
        else ++b;
    }
}

void main() {
    uint list = gl_GlobalInvocationID.x;
    if (list >= lists) return;
    uint begin = offsets[list], count = offsets[list + 1] - begin, room = offsets[lists];
    if (count < 2 || count > kSortLongest) return;
    uint levels = uint(findMSB(count - 1)) + 1;  // runs of 2^levels hold the list
    bool there = (levels & 1) == 0;              // the pairs go where the last merge ends at the ids
    sortPairs(begin, there ? room + begin : begin, count);
    for (uint level = 1; level < levels; ++level) {
        mergeRuns(there ? room + begin : begin, there ? begin : room + begin, count, 1u << level);
        there = !there;
    }
}
