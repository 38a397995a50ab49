#include "pipeline/methods/sample_weights.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "pipeline/error.h"
#include "pipeline/methods/point_samples.h"

namespace edgewise {
namespace {

struct Table {
    int side;
    std::vector<double> weight;
};

Table evaluateTable(const Prefilter& filter, int per_side, int margin_px) {
    Table table{(2 * margin_px + 1) * per_side, {}};
    auto position = [&](int i) {
        return i / per_side - margin_px + sampleOffsetPx(i % per_side, per_side) - 0.5;
    };
    for (int row = 0; row < table.side; ++row)
        for (int column = 0; column < table.side; ++column)
            table.weight.push_back(evaluate(filter, position(column), position(row)));
    return table;
}

/// Half, in samples: the table of weights is quadratic.
constexpr double kWidestSupport = 4096.0;

/// A fixed-point weight holds -8 to 8: no owner can get more than the sum of all weights' sizes.
constexpr double kLargestWeight = 7.0;

/// Rounded to 2^-60; the largest weight takes up what rounding left, so that the sum is exactly 1.
std::vector<FixedWeight> normalise(const Table& table) {
    double sum = 0.0, size = 0.0;
    for (const double w : table.weight) {
        sum += w;
        size += std::fabs(w);
    }
    if (!(sum > 0.0))
        throw InputError("ssaa",
                         "the samples' weights do not sum to more than 0: none meets the filter's support; "
                         "use more samples or a larger radius");
    if (size > kLargestWeight * sum)
        throw FailureError(
            "ssaa",
            "the filter's negative lobes nearly cancel its positive ones: some pixel's weights "
            "could exceed 7");
    std::vector<FixedWeight> fixed;
    FixedWeight rest = FixedWeight(1) << kWeightBits;
    for (const double w : table.weight) {
        fixed.push_back(static_cast<FixedWeight>(std::llround(std::ldexp(w / sum, kWeightBits))));
        rest -= fixed.back();
    }
    *std::max_element(fixed.begin(), fixed.end()) += rest;
    return fixed;
}

SampleWeights::Row makeRow(const FixedWeight* weight, int side) {
    int first = 0, last = side;
    while (first < side && weight[first] == 0) ++first;
    while (last > first && weight[last - 1] == 0) --last;
    SampleWeights::Row row{first, {0}};
    for (int i = first; i < last; ++i) row.running.push_back(row.running.back() + weight[i]);
    return row;
}

}  // namespace

SampleWeights::SampleWeights(const Prefilter& filter, int per_side) {
    if (filter.radius * per_side > kWidestSupport)
        throw FailureError("ssaa", "the filter's support is wider than 8192 samples");
    margin_px = static_cast<int>(std::ceil(std::max(filter.radius - 0.5, 0.0)));
    const Table table = evaluateTable(filter, per_side, margin_px);
    const std::vector<FixedWeight> fixed = normalise(table);
    for (int row = 0; row < table.side; ++row)
        rows.push_back(makeRow(fixed.data() + static_cast<std::size_t>(row) * table.side, table.side));
}

SampleWeights SampleWeights::equal(int samples) {
    SampleWeights weights;
    Row row{0, {0}};
    for (int i = 0; i < samples; ++i)
        row.running.push_back(row.running.back() + (FixedWeight(1) << kWeightBits) / samples);
    weights.rows.push_back(row);
    return weights;
}

SampleWeights SampleWeights::none(int margin_px) {
    SampleWeights weights;
    weights.margin_px = margin_px;
    return weights;
}

}  // namespace edgewise
