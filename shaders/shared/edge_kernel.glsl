// GLSL only: what analytic/lane_kernel.h is in C++. A kernel's numbers lie in one buffer, kernelNumber(i), which its parts
// are places in: WeightKernel in pipeline/vulkan/weight_kernel.cpp fills it in this order.

#include "shared/edge_input.glsl"

struct RuleView {
    int count, node, weight;
};
struct PieceRule {
    work limit_sigma;
    RuleView rule;
};
struct TableView {
    int intervals, k_count, knot, centre, inverse_half, k, K;
    RuleView rule;
};

const int kDiskTerm = 0;
const int kConeTerm = 1;
const int kGaussianTerm = 2;
const int kPolyTerm = 3;
const int kStripTerm = 4;

const double kLongestPieceSigmas = EDGEWISE_REAL(3.0);
const int kPieceRules = 3;
const int kMostCellNodes = 24;
const int kMostIntervals = 32;
#define EDGEWISE_BY_INVOCATION

layout(constant_id = 0) const int kForm = 0;
layout(constant_id = 1) const int kRule0 = 0;
layout(constant_id = 2) const int kRule1 = 0;
layout(constant_id = 3) const int kRule2 = 0;
layout(constant_id = 4) const int kPolyNodes = 0;
layout(constant_id = 5) const int kIntervals = 0;
layout(constant_id = 6) const int kFactorCount = 0;
layout(constant_id = 7) const int kCellNodes = 0;

struct LaneKernel {
    int form;
    double radius, inner_radius;
    work scale, sigma, inverse_reach;
    PieceRule piece_rules[kPieceRules];
    int poly;
    RuleView poly_rule;
    TableView table;
};
LaneKernel kernel;

#define EDGEWISE_NUMBERS int
#define EDGEWISE_AT(numbers, i) kernelNumber((numbers) + (i))
#define EDGEWISE_KERNEL_IN
#define EDGEWISE_KERNEL

RuleView ruleAt(inout int place, int count) {
    RuleView rule = RuleView(count, place, place + count);
    place += 2 * count;
    return rule;
}

void readKernel(double radius, double inner_radius) {
    kernel.form = kForm;
    kernel.radius = radius;
    kernel.inner_radius = inner_radius;
    kernel.scale = kernelNumber(0);
    kernel.sigma = kernelNumber(1);
    kernel.inverse_reach = kernelNumber(2);
    int place = 6;
    kernel.piece_rules[0] = PieceRule(kernelNumber(3), ruleAt(place, kRule0));
    kernel.piece_rules[1] = PieceRule(kernelNumber(4), ruleAt(place, kRule1));
    kernel.piece_rules[2] = PieceRule(kernelNumber(5), ruleAt(place, kRule2));
    kernel.poly = place;
    place += kPolyNodes;
    kernel.poly_rule = ruleAt(place, kPolyNodes);
    kernel.table.intervals = kIntervals;
    kernel.table.k_count = kFactorCount;
    kernel.table.knot = place;
    kernel.table.centre = kernel.table.knot + kIntervals + 1;
    kernel.table.inverse_half = kernel.table.centre + kIntervals;
    kernel.table.k = kernel.table.inverse_half + kIntervals;
    kernel.table.K = kernel.table.k + kIntervals * kFactorCount;
    place = kernel.table.K + kIntervals * (kFactorCount + 1);
    kernel.table.rule = ruleAt(place, kCellNodes);
}
