#include "pipeline/methods/pattern_weights.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "pipeline/error.h"

namespace edgewise {
namespace {

constexpr double kMostSamples = 0x1p22;

double reachOf(const Prefilter& filter) {
    const double side = 2.0 * std::ceil(std::max(filter.radius - 0.5, 0.0)) + 1.0;
    return side * side;
}

}  // namespace

int PatternWeights::marginPx(const Prefilter& filter) {
    return static_cast<int>(std::ceil(std::max(filter.radius - 0.5, 0.0)));
}

PatternWeights::PatternWeights(const Prefilter& filter, const PixelPatterns& patterns)
    : samples_(patterns.samples) {
    if (reachOf(filter) * patterns.samples > kMostSamples)
        throw FailureError("rt",
                           fmt::format("the filter's support holds more than {:.0f} samples", kMostSamples));
    const int margin = marginPx(filter), side = 2 * margin + 1;
    reach_ = side * side;
    std::vector<double> value(patterns.at_px.size() * reach_);
    tbb::parallel_for(std::size_t(0), patterns.at_px.size(), [&](std::size_t s) {
        for (int k = 0; k < reach_; ++k) {
            const glm::dvec2 to(k % side - margin, k / side - margin);
            const glm::dvec2 at = patterns.at_px[s] - 0.5 - to;
            value[s * reach_ + k] = evaluate(filter, at.x, at.y);
        }
    });
    double largest = 0.0;
    for (const double w : value) largest = std::max(largest, std::fabs(w));
    const double unit = largest > 0.0 ? 0x1p60 / (largest * reach_ * samples_) : 0.0;
    weights_.resize(value.size());
    for (std::size_t i = 0; i < value.size(); ++i)
        weights_[i] = std::llround(value[i] * unit * (1 - 0x1p-40));
    totals_.assign(patterns.count() * reach_, 0);
    for (std::size_t i = 0; i < weights_.size(); ++i)
        totals_[i / (std::size_t(samples_) * reach_) * reach_ + i % reach_] += weights_[i];
}

std::size_t patternCount(const Prefilter& filter, int samples) {
    const double table_bytes = 0x1p24, bytes = reachOf(filter) * samples * sizeof(FixedWeight);
    return std::bit_floor(static_cast<std::size_t>(std::clamp(table_bytes / bytes, 4.0, 256.0)));
}

}  // namespace edgewise
