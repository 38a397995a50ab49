#include "tests/studies/term_bounds/observed_terms.h"

#include "analytic/carrier.h"

#define EDGEWISE_ISA observed_isa
#define EDGEWISE_LANES 1
#include "analytic/edge_lanes.inl"

namespace edgewise::study {
namespace {

namespace isa = observed_isa;

void observeFan(const LaneKernel& kernel, const isa::Line& line, ObservedTerm& out) {
    const isa::DiskCut cut = isa::cutByDisk(kernel, line);
    out.t1 = cut.t1, out.t2 = cut.t2;
}

}  // namespace

Edge canonical(const Edge& e) {
    const bool turned = e.a.y > e.b.y || (e.a.y == e.b.y && e.a.x < e.b.x);
    return turned ? Edge{e.b, e.a} : e;
}

EdgeInput inputOf(const Edge& e) {
    const glm::dvec2 a = e.a + kSample, b = e.b + kSample;  // exact: on the grid
    const CarrierLine l = carrierLine({LineRef::edge(0, 0), a, b});
    return {a.x,           a.y,          0.0,
            0.0,           b.x,          b.y,
            0.0,           0.0,          distance(gridPoint(a), gridPoint(b)),
            l.origin.x,    l.origin.y,   l.nx_hi,
            l.nx_lo,       l.ny_hi,      l.ny_lo,
            l.c_hi,        l.c_lo,       l.length,
            l.direction.x, l.direction.y};
}

ObservedTerm observe(const EdgeKernel& kernel, const Edge& edge) {
    ObservedTerm out{};
    const EdgeInput input = inputOf(edge);
    const EdgePair pair{&input, kSample.x, kSample.y};
    const isa::Line line = isa::lineOf(&pair);
    const bool strip = kernel.lanes.form == kStripTerm;
    const isa::EdgeTerm term =
        strip ? isa::stripTerms(kernel.lanes, line) : isa::fanTerms(kernel.lanes, line);
    isa::storeTerm(term, 0, out.fixed);
    out.term = term.touched ? term.value : 0.0;
    if (!strip) observeFan(kernel.lanes, line, out);
    out.touched = out.fixed.touched & 1u;
    out.entered = out.fixed.crossed[0] & 1u, out.left = out.fixed.crossed[1] & 1u;
    return out;
}

}  // namespace edgewise::study
