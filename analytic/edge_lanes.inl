// edgeTerms() for one instruction set: define EDGEWISE_ISA (a namespace) and EDGEWISE_LANES (1, 2, 4 or 8), and
// EDGEWISE_FP32 for float terms, then include. Nothing here may call an inline function of another namespace: it could
// be linked into code for an older machine.
#include "analytic/lane_kernel.h"
#include "analytic/shared_text.h"

#if defined(__x86_64__) && EDGEWISE_LANES > 1 && !defined(EDGEWISE_X86)
#include <immintrin.h>
#define EDGEWISE_X86
#endif

namespace edgewise::EDGEWISE_ISA {
namespace {
#include "analytic/real_lanes.h"
#include "shaders/shared/double_double.glsl"
#include "shaders/shared/transcendental.glsl"
#ifdef EDGEWISE_FP32
#include "shaders/shared/transcendental_float.glsl"
#endif
#include "shaders/shared/fan_terms.glsl"
#include "shaders/shared/edge_line.glsl"
#include "shaders/shared/edge_work.glsl"
#include "shaders/shared/edge_fan.glsl"
#include "shaders/shared/edge_strip.glsl"

EDGEWISE_FN void store(bits value, int first, std::int64_t* out) { __builtin_memcpy(out + first, &value, sizeof value); }
EDGEWISE_FN void store(real value, int first, double* out) { __builtin_memcpy(out + first, &value, sizeof value); }

EDGEWISE_FN void storeCrossing(const BorderPoint& point, int slot, int first, EdgeTerms& terms) {
    const unsigned crossed = laneSet(point.crossed) << first;
    terms.crossed[slot] |= crossed;
    if (!crossed) return;
    store(toFixed(realOf(point.position)), first, terms.position[slot]);
    store(point.order, first, terms.order[slot]);
    store(point.doubt, first, terms.doubt[slot]);
    store(point.spread, first, terms.spread[slot]);
}

EDGEWISE_FN void storeTerm(const EdgeTerm& term, int first, EdgeTerms& terms) {
    terms.touched |= laneSet(term.touched) << first;
    const real value = realOf(term.value);
    store(toFixed(term.touched ? value : splat(0.0)), first, terms.value);
    storeCrossing(term.entry, 0, first, terms);
    storeCrossing(term.exit, 1, first, terms);
}
}  // namespace

void edgeTerms(const LaneKernel& kernel, const EdgeInput& input, EdgeTerms& terms);
void edgeTerms(const LaneKernel& kernel, const EdgeInput& input, EdgeTerms& terms) {
    terms.touched = terms.crossed[0] = terms.crossed[1] = 0;
    for (int first = 0; first < 8; first += EDGEWISE_LANES) {
        const double x = input.sample_x + first;
        if (!boxesMeet(input, kernel.radius, x, x + (EDGEWISE_LANES - 1))) {
            store(bits{}, first, terms.value);
            continue;
        }
        const Line line = lineAt(input, x + laneNumbers());
        storeTerm(kernel.form == kStripTerm ? stripTerms(kernel, line) : fanTerms(kernel, line), first, terms);
    }
}

}  // namespace edgewise::EDGEWISE_ISA
