// The filter at the samples around a pixel: the same table for every pixel of a regular sample lattice.
#pragma once

#include <cstdint>
#include <vector>

#include "analytic/pixel_weights.h"

namespace edgewise {

/// Weights in fixed point that sum to exactly 2^60, as running sums along each row: the weight of a run of
/// samples that one owner covers is one exact difference.
struct SampleWeights {
    struct Row {
        int first = 0;                     ///< leftmost sample, counted from the window's left
        std::vector<FixedWeight> running;  ///< running[j]: the weights of the first j samples from `first`
        FixedWeight of(int begin, int end) const { return running[end] - running[begin]; }
        int size() const { return static_cast<int>(running.size()) - 1; }
    };
    int margin_px = 0;      ///< the window is the pixel and this many pixels around it
    std::vector<Row> rows;  ///< (2 margin + 1) K rows from the window's top; empty ones reach no sample

    /// Throws InputError if no sample meets the support, or their weights sum to 0 or less; FailureError
    /// where fixed point could overflow, the sizes of the weights summing to more than 7, or the support is
    /// wider than 8192 samples.
    SampleWeights(const Prefilter& filter, int per_side);

    /// One row of so many samples, a power of 2, that weigh alike; no margin.
    static SampleWeights equal(int samples);

    /// No weights: for stages that weigh by themselves.
    static SampleWeights none(int margin_px);

  private:
    SampleWeights() = default;
};

}  // namespace edgewise
