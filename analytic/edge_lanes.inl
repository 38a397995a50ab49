// edgeTerms() for one instruction set: define EDGEWISE_ISA (a namespace) and EDGEWISE_LANES (1, 2, 4 or 8), then include.
// Nothing here may call an inline function of another namespace: it could be linked into code for an older machine.
#include "analytic/lane_kernel.h"
#include "analytic/shared_text.h"

#if defined(__x86_64__) && EDGEWISE_LANES > 1
#include <immintrin.h>
#define EDGEWISE_X86
#endif

namespace edgewise::EDGEWISE_ISA {
namespace {
#include "analytic/real_lanes.h"
#include "shaders/shared/double_double.glsl"
#include "shaders/shared/transcendental.glsl"
#include "shaders/shared/fan_terms.glsl"
#include "analytic/edge_lanes_line.inl"
#include "analytic/edge_lanes_fan.inl"
#include "analytic/edge_lanes_strip.inl"
}  // namespace

void edgeTerms(const LaneKernel& kernel, const EdgeInput& input, EdgeTerms& terms);
void edgeTerms(const LaneKernel& kernel, const EdgeInput& input, EdgeTerms& terms) {
    terms.touched = terms.crossed[0] = terms.crossed[1] = 0;
    for (int first = 0; first < 8; first += EDGEWISE_LANES) {
        if (!boxesMeet(input, kernel.radius, first)) {
            store(bits{}, first, terms.value);
            continue;
        }
        const Line line = lineAt(input, first);
        if (kernel.form == TermForm::kStrip)
            stripTerms(kernel, line, first, terms);
        else
            fanTerms(kernel, line, first, terms);
    }
}

}  // namespace edgewise::EDGEWISE_ISA
