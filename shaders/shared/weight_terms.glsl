// One invocation a segment and a pixel that it may touch: its term goes to the sums of the segment's two owners, its
// crossings with the support's border to the pixel's notes. Sums are exact, so that order is nothing.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#extension GL_EXT_control_flow_attributes : require
#define EDGEWISE_READS_KERNEL
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
    return EdgeInput(s.a_grid[0], s.a_grid[1], s.a_rest[0], s.a_rest[1], s.b_grid[0], s.b_grid[1],
                     s.b_rest[0], s.b_rest[1], s.len, l.origin_x, l.origin_y, l.nx_hi, l.nx_lo, l.ny_hi, l.ny_lo, l.c_hi,
                     l.c_lo, l.len, l.direction_x, l.direction_y);
}

void addTo(uint place, bits value) {
    if (value != 0l) atomicAdd(sums[sumIndex(place)], value);
}

/// Puts what pair `at` has met before the pixel's chain.
void leaveNote(uint at, double first, double second, uint kind, GpuPair pair) {
    uint note = at * kNotesPerPair + (kind == kNoteBaseRight ? kNoteBaseLeft : kind);
    uint next = atomicExchange(states[stateIndex()].notes, note + 1u);
    notes[note] = GpuBorderNote(first, second, next, kind, pair.left, pair.right);
}

void considerBaseOf(uint at, GpuPair pair, EdgeInput seen) {
    double near = 9.313225746154785e-10lf;  // 2^-30 px: considerBase() looks no farther than 2^-31
    if (smaller(seen.a_y, seen.b_y) > sampleY() + near || larger(seen.a_y, seen.b_y) < sampleY() - near) return;
    double base_x = sampleX() + push.radius;
    if (smaller(seen.a_x, seen.b_x) > base_x + near || larger(seen.a_x, seen.b_x) < base_x - near) return;
    BasePoint base = noBasePoint();
    considerBase(base, kForm != kStripTerm, push.radius, seen, sampleX(), sampleY(), kNoteBaseLeft, kNoteBaseRight);
    if (isKnown(base)) leaveNote(at, base.distance2, base.cosine, base.owner, pair);
}

/// What a crossing moves from the right owner to the left one on the way in, and back on the way out.
bits shareOf(BorderPoint point) { return point.crossed ? toFixed(realOf(point.position)) : bits(0); }

void main() {
    uint at = flatIndex();
    if (at >= push.count) return;
    GpuPair pair = pairs[at];
    tile_index = pair.pixel / 64u;
    place_in_tile = pair.pixel % 64u;
    sums_begin = pair.sums;
    readKernel(push.radius, push.inner_radius);
    EdgeInput seen = inputOf(pair.segment);
    considerBaseOf(at, pair, seen);
    Line line = lineAt(seen, sampleX(), sampleY());
    EdgeTerm term;
    if (kForm == kStripTerm)
        term = stripTerms(line);
    else
        term = fanTerms(line);
    if (!term.touched) return;
    atomicAdd(states[stateIndex()].touched, 1u);
    bits value = toFixed(realOf(term.value)) + shareOf(term.entry) - shareOf(term.exit);
    addTo(pair.left, value);
    addTo(pair.right, -value);
    if (term.entry.crossed) leaveNote(at, term.entry.order, term.entry.doubt, kNoteEntry, pair);
    if (term.exit.crossed) leaveNote(at, term.exit.order, term.exit.doubt, kNoteExit, pair);
}
