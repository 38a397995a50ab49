#include "pipeline/vulkan/weight_kernel.h"

#include <fmt/format.h>

#include "pipeline/vulkan/weight_lists.h"

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

}  // namespace

std::optional<std::string> whyNotWeighed(const Prefilter& filter) {
    const WeightKernel made(filter, Precision::kFp64);
    const int pieces = made.kernel.lanes.table.intervals;
    if (pieces <= kMostIntervals && made.numbers.size() <= kKernelNumbers) return std::nullopt;
    return fmt::format("the filter has {} polynomial pieces along a side, its shader holds {}", pieces,
                       kMostIntervals);
}

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
}

}  // namespace edgewise::vulkan
