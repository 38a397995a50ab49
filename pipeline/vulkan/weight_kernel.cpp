#include "pipeline/vulkan/weight_kernel.h"

#include <cmath>

namespace edgewise::vulkan {
namespace {

void append(std::vector<double>& numbers, const double* from, int count) {
    if (count > 0) numbers.insert(numbers.end(), from, from + count);
}
void append(std::vector<double>& numbers, const RuleView& rule) {
    append(numbers, rule.node, rule.count);
    append(numbers, rule.weight, rule.count);
}
void append(std::vector<double>& numbers, const TableView& table) {
    const int m = table.intervals, n = table.k_count;
    append(numbers, table.knot, m == 0 ? 0 : m + 1);
    if (m == 0) numbers.push_back(0.0);  // one knot more than intervals
    append(numbers, table.centre, m);
    append(numbers, table.inverse_half, m);
    append(numbers, table.k, m * n);
    append(numbers, table.K, m * (n + 1));
    append(numbers, table.rule);
}

/// Loops turn once more than they run.
std::size_t gaussianTurns(const LaneKernel& kernel) {
    const double longest = 2.0 * kernel.inner_radius / (kLongestPieceSigmas * kernel.sigma);
    const auto parts = static_cast<std::size_t>(std::ceil(longest)) + 2;
    std::size_t turns = 0;
    for (int i = 0; i < kPieceRules; ++i) {
        const auto nodes = static_cast<std::size_t>(kernel.piece_rules[i].rule.count);
        // the first rules are for pieces that are one part
        turns += 2 + (i == kPieceRules - 1 ? parts : 2) * (nodes + 2);
    }
    return turns;
}
std::size_t polyTurns(const LaneKernel& kernel) {
    const auto nodes = static_cast<std::size_t>(kernel.poly_rule.count);
    return (nodes + 1) * (nodes + 1);
}
std::size_t stripTurns(const TableView& table) {
    const auto m = static_cast<std::size_t>(table.intervals), n = static_cast<std::size_t>(table.k_count);
    const std::size_t cell = (static_cast<std::size_t>(table.rule.count) + 1) * (2 * n + 3);
    return (m + 1) * ((m + 1) * (cell + 1) + 1) + (m + 1) * (n + 2);
}
std::size_t turnsOf(const LaneKernel& kernel) {
    switch (kernel.form) {
        case kGaussianTerm:
            return gaussianTurns(kernel);
        case kPolyTerm:
            return polyTurns(kernel);
        case kStripTerm:
            return stripTurns(kernel.table);
        default:
            return 0;
    }
}

}  // namespace

WeightKernel::WeightKernel(const Prefilter& filter, Precision precision) : kernel(filter, precision) {
    const LaneKernel& lanes = kernel.lanes;
    numbers = {lanes.scale, lanes.sigma, lanes.inverse_reach};
    for (const PieceRule& rule : lanes.piece_rules) numbers.push_back(rule.limit_sigma);
    for (const PieceRule& rule : lanes.piece_rules) append(numbers, rule.rule);
    append(numbers, lanes.poly, lanes.poly_rule.count);
    append(numbers, lanes.poly_rule);
    append(numbers, lanes.table);
    const auto word = [](int n) { return static_cast<std::uint32_t>(n); };
    constants = {word(lanes.form),
                 word(lanes.piece_rules[0].rule.count),
                 word(lanes.piece_rules[1].rule.count),
                 word(lanes.piece_rules[2].rule.count),
                 word(lanes.poly_rule.count),
                 word(lanes.table.intervals),
                 word(lanes.table.k_count),
                 word(lanes.table.rule.count)};
    turns = 1 + turnsOf(lanes);
}

}  // namespace edgewise::vulkan
