#include "analytic/edge_integral.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "analytic/instruction_set.h"
#include "analytic/quad_real.h"

namespace edgewise {

#define EDGEWISE_DECLARE_TERMS(isa)                                          \
    namespace isa {                                                          \
    void edgeTerms(const LaneKernel&, const EdgePair*, int, EdgeTerms&);     \
    }                                                                        \
    namespace isa##_fp32 {                                                   \
        void edgeTerms(const LaneKernel&, const EdgePair*, int, EdgeTerms&); \
    }
EDGEWISE_DECLARE_TERMS(scalar)
EDGEWISE_DECLARE_TERMS(sse2)
#if defined(EDGEWISE_HAS_AVX)
EDGEWISE_DECLARE_TERMS(avx2)
EDGEWISE_DECLARE_TERMS(avx512)
#endif

namespace {

/// Constants are made in 113 bits and rounded once: they are in every term.
double rounded(QuadReal x) {
    return static_cast<double>(x);
}

/// e^-(9.25^2 / 2) < 2^-61.
constexpr double kGaussianReach = 9.25;

/// Nodes for pieces of up to `limit` sigmas: |F| errs by |h| L' / (4 pi sigma^2) times the mean's error, and
/// |phi1(v + iw)| <= max(1, e^-v), so at |Im t| <= y it is at most e^max(0, (y^2 - h^2)/2). [E9]
GaussRule pieceRule(double limit, double tolerance) {
    const double h_most = kGaussianReach;
    const auto growth = [=](double y) {
        // sup over h of h max(1, e^((y^2 - h^2)/2)): h <= reach, and h e^(-h^2/2) <= e^(-1/2)
        return std::max(h_most, std::exp((y * y - 1) / 2)) * limit / (4 * M_PI);
    };
    return gaussRule(nodesNeeded(growth, limit, tolerance));
}

RuleView viewOf(const GaussRule& rule) {
    return {rule.count(), rule.node.data(), rule.weight.data()};
}

TableView viewOf(const KernelTable& table) {
    return {table.intervals(),         table.k_count,  table.knot.data(), table.centre.data(),
            table.inverse_half.data(), table.k.data(), table.K.data(),    table.k_max,
            viewOf(table.rule)};
}

/// (1 - e^-v)/v.
QuadReal quadPhi1(QuadReal v) {
    if (v > QuadReal(0x1p-10)) return (1 - quadExp(-v)) / v;
    QuadReal sum = 0;  // eleven terms leave v^11/12! < 2^-138
    for (int k = 11; k >= 1; --k) sum = (1 - v * sum) / k;
    return sum;
}

void prepareGaussian(EdgeKernel& kernel, const Prefilter& filter, Precision precision) {
    LaneKernel& lanes = kernel.lanes;
    lanes.form = kGaussianTerm;
    lanes.sigma = filter.sigma.value_or(filter.radius / 3.0);
    const QuadReal twice = 2 * QuadReal(lanes.sigma) * lanes.sigma;
    lanes.inverse_reach = rounded(1 / quadSqrt(twice));
    lanes.inner_radius = std::min(filter.radius, kGaussianReach * lanes.sigma);
    const QuadReal reach = lanes.inner_radius;
    lanes.scale = rounded(1 / (2 * quadPi() * reach * reach * quadPhi1(reach * reach / twice)));
    const double tolerance = precision == Precision::kFp32 ? 0x1p-30 : 0x1p-62;
    constexpr double kLimits[kPieceRules] = {0.5, 1.0, kLongestPieceSigmas};
    for (int i = 0; i < kPieceRules; ++i) {
        kernel.piece_rules[i] = pieceRule(kLimits[i], tolerance);
        lanes.piece_rules[i] = {kLimits[i], viewOf(kernel.piece_rules[i])};
    }
}

void preparePoly(EdgeKernel& kernel, const Prefilter& filter) {
    QuadReal integral = 0;
    for (std::size_t k = 0; k < filter.poly.size(); ++k) {
        kernel.poly.push_back(filter.poly[k] / static_cast<double>(2 * k + 2));
        integral += QuadReal(filter.poly[k]) / static_cast<int>(2 * k + 2);
    }
    kernel.poly_rule = gaussRule(static_cast<int>(filter.poly.size()));
    kernel.lanes.form = kPolyTerm;
    kernel.lanes.scale = rounded(1 / (2 * quadPi() * filter.radius * filter.radius * integral));
    kernel.lanes.poly = kernel.poly.data();
    kernel.lanes.poly_rule = viewOf(kernel.poly_rule);
}

void prepareStrip(EdgeKernel& kernel, const Prefilter& filter) {
    kernel.table = filter.table ? filter.table : std::make_shared<KernelTable>(makeKernelTable(filter));
    kernel.lanes.form = kStripTerm;
    kernel.lanes.table = viewOf(*kernel.table);
}

}  // namespace

EdgeKernel::EdgeKernel(const Prefilter& filter, Precision precision) {
    const QuadReal R2 = QuadReal(filter.radius) * filter.radius;
    lanes.radius = lanes.inner_radius = filter.radius;
    switch (filter.kind) {
        case KernelKind::kDisk:
            lanes.form = kDiskTerm;
            lanes.scale = rounded(1 / (2 * quadPi() * R2));
            return;
        case KernelKind::kCone:
            lanes.form = kConeTerm;
            lanes.scale = rounded(3 / (quadPi() * R2));
            return;
        case KernelKind::kGaussian:
            prepareGaussian(*this, filter, precision);
            return;
        case KernelKind::kPoly:
            preparePoly(*this, filter);
            return;
        default:
            prepareStrip(*this, filter);
    }
}

EdgeTermsFunction edgeTermsFor(const char* instruction_set, Precision precision) {
    if (!machineRuns(instruction_set)) return nullptr;
    const bool fp32 = precision == Precision::kFp32;
    const auto is = [=](const char* name) { return std::strcmp(instruction_set, name) == 0; };
    if (is("scalar")) return fp32 ? scalar_fp32::edgeTerms : scalar::edgeTerms;
    if (is("sse2")) return fp32 ? sse2_fp32::edgeTerms : sse2::edgeTerms;
#if defined(EDGEWISE_HAS_AVX)
    if (is("avx2")) return fp32 ? avx2_fp32::edgeTerms : avx2::edgeTerms;
    if (is("avx512")) return fp32 ? avx512_fp32::edgeTerms : avx512::edgeTerms;
#endif
    return nullptr;
}

EdgeTermsFunction chooseEdgeTerms(Precision precision) {
    return bestForm([=](const char* name) { return edgeTermsFor(name, precision); });
}

}  // namespace edgewise
