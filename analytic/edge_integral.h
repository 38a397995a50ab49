// One signed term a (segment, sample): fan terms of radial kernels inside their disk, strip terms of
// separable ones inside their square, and where the segment crosses the support's border. The code behind
// edgeTerms() is built once an instruction set, all with the same bits.
#pragma once

#include <array>
#include <memory>

#include "analytic/gauss_legendre.h"
#include "analytic/kernel_table.h"
#include "analytic/lane_kernel.h"
#include "analytic/precision.h"
#include "analytic/prefilter.h"

namespace edgewise {

/// A kernel prepared for its terms; `lanes` points into the rest. For kFp32 the Gaussian's quadrature is as
/// fine as float needs.
struct EdgeKernel {
    LaneKernel lanes;
    std::array<GaussRule, kPieceRules> piece_rules;
    GaussRule poly_rule;
    std::vector<double> poly;
    std::shared_ptr<const KernelTable> table;

    explicit EdgeKernel(const Prefilter& filter, Precision precision = Precision::kFp64);
    EdgeKernel(const EdgeKernel&) = delete;
    EdgeKernel& operator=(const EdgeKernel&) = delete;
};

/// Errors, u = 2^-53, the rounding to fixed point of 2^-61 apart, for ends exact relative to the sample: the
/// part inside the support, of a kernel that is nowhere negative, <= 16 u relative (of a clipped segment:
/// between its clip points); with its crossings' positions <= 16 u absolute, separable kernels likewise.
/// With kFp32 u is 2^-24 and the fixed point does not count.
/// Measured over nine adversarial categories of edges: tests/studies/term_bounds; its numbers are at [E9].
/// Of up to kMostPairs pairs: a term does not depend on what pairs share its call.
using EdgeTermsFunction = void (*)(const LaneKernel&, const EdgePair* pairs, int count, EdgeTerms&);

/// The best form that this machine runs, or the one that EDGEWISE_ISA=scalar|sse2|avx2|avx512 names.
EdgeTermsFunction chooseEdgeTerms(Precision precision = Precision::kFp64);
/// By name; nullptr where this machine or build has none.
EdgeTermsFunction edgeTermsFor(const char* instruction_set, Precision precision = Precision::kFp64);

}  // namespace edgewise
