// A tile's pixels, an invocation each, take the next segments of the tile's list: terms go to the sums of the segments'
// two owners, crossings with the support's border to the pixel's state. Sums are exact, so that order is nothing.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/weight_buffers.glsl"
#include "shared/edge_kernel.glsl"
#define bits int64_t
bits truncated(double x) { return int64_t(x); }
#ifdef EDGEWISE_FP32
#include "shared/transcendental_float.glsl"
#endif
#include "shared/fan_terms.glsl"
#include "shared/edge_line.glsl"
#include "shared/edge_work.glsl"
#include "shared/edge_fan.glsl"
#include "shared/edge_strip.glsl"
#include "shared/base_point.glsl"

EdgeInput inputOf(uint id) {
    GpuSegment s = segments[id];
    GpuCarrierLine l = lines[s.line];
    return EdgeInput(sampleX(), sampleY(), s.a_grid[0], s.a_grid[1], s.a_rest[0], s.a_rest[1], s.b_grid[0], s.b_grid[1],
                     s.b_rest[0], s.b_rest[1], s.len, l.origin_x, l.origin_y, l.nx_hi, l.nx_lo, l.ny_hi, l.ny_lo, l.c_hi,
                     l.c_lo, l.len, l.direction_x, l.direction_y);
}

GpuPixelState freshState() {
    BasePoint none = noBasePoint();
    return GpuPixelState(none.distance2, none.cosine, 1e300lf, 1e300lf, 1e300lf, -1e300lf, -1e300lf, -1e300lf, none.owner, 0u,
                         0u, 0u, 0u, 0u, 0u, 0u);
}

void addTo(uint place, bits value) { sums[sumIndex(place)] += value; }

void addCrossing(inout GpuPixelState state, BorderPoint point, uint before, uint after) {
    if (!point.crossed) return;
    bits position = toFixed(realOf(point.position));
    addTo(before, position);
    addTo(after, -position);
    uint64_t balance = packUint2x32(uvec2(state.balance_low, state.balance_high)) + hashOf(ownerAt(before)) - hashOf(ownerAt(after));
    state.balance_low = unpackUint2x32(balance).x;
    state.balance_high = unpackUint2x32(balance).y;
    ++state.crossings;
    double low = point.order - point.doubt;
    double high = point.order + point.doubt;
    if (low < state.first_low) {
        state.next_low = state.first_low;
        state.first_low = low;
        state.first_high = high;
        state.first_owner = before;
    } else {
        state.next_low = smaller(state.next_low, low);
    }
    if (high > state.last_high) {
        state.before_high = state.last_high;
        state.last_high = high;
        state.last_low = low;
        state.last_owner = after;
    } else {
        state.before_high = larger(state.before_high, high);
    }
}

/// Read before the rest is: most segments of a tile miss a row of its pixels.
bool isNear(uint id) {
    EdgeInput seen;
    seen.sample_y = sampleY();
    seen.a_x = segments[id].a_grid[0];
    seen.a_y = segments[id].a_grid[1];
    seen.b_x = segments[id].b_grid[0];
    seen.b_y = segments[id].b_grid[1];
    return boxesMeet(seen, push.radius, sampleX(), sampleX());
}

void considerBaseOf(GpuTileSegment entry, EdgeInput seen, inout GpuPixelState state) {
    double near = 9.313225746154785e-10lf;  // 2^-30 px: considerBase() looks no farther than 2^-31
    if (smaller(seen.a_y, seen.b_y) > seen.sample_y + near || larger(seen.a_y, seen.b_y) < seen.sample_y - near) return;
    double base_x = seen.sample_x + push.radius;
    if (smaller(seen.a_x, seen.b_x) > base_x + near || larger(seen.a_x, seen.b_x) < base_x - near) return;
    BasePoint base = BasePoint(state.base_distance2, state.base_cosine, state.base_owner);
    considerBase(base, kForm != kStripTerm, push.radius, seen, seen.sample_x, ownerAt(entry.left), ownerAt(entry.right));
    state.base_distance2 = base.distance2;
    state.base_cosine = base.cosine;
    state.base_owner = base.owner;
}

void takeSegment(GpuTileSegment entry, inout GpuPixelState state) {
    if (!isNear(entry.segment)) return;
    EdgeInput seen = inputOf(entry.segment);
    considerBaseOf(entry, seen, state);
    Line line = lineAt(seen, seen.sample_x);
    EdgeTerm term;
    if (kForm == kStripTerm)
        term = stripTerms(line);
    else
        term = fanTerms(line);
    if (!term.touched) return;
    ++state.touched;
    bits value = toFixed(realOf(term.value));
    addTo(entry.left, value);
    addTo(entry.right, -value);
    addCrossing(state, term.entry, entry.left, entry.right);
    addCrossing(state, term.exit, entry.right, entry.left);
}

void main() {
    if (!hasPixel()) return;
    readKernel(push.radius, push.inner_radius);
    uint begin = offsets[listed_tile] / 2u + push.first;
    uint end = min(begin + push.count, offsets[listed_tile + 1u] / 2u);
    if (push.first > 0u && begin >= end) return;
    GpuPixelState state = freshState();
    if (push.first > 0u) state = states[stateIndex()];
    for (uint k = begin; k < end; ++k) takeSegment(entries[k], state);
    states[stateIndex()] = state;
}
