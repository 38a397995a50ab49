// The filter at the samples of pixels that have patterns of their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analytic/pixel_weights.h"
#include "pipeline/pixel_patterns.h"

namespace edgewise {

/// What each sample of a pixel weighs for the pixels around it, in whole numbers of one unit, so that sums
/// are exact in any order: what reaches a pixel from all samples sums to less than 2^60. The pixel divides by
/// its own sum, which other pixels' patterns enter too.
class PatternWeights {
  public:
    /// Throws FailureError where a pixel's support holds more than 2^22 samples.
    PatternWeights(const Prefilter& filter, const PixelPatterns& patterns);

    /// A pixel's samples reach those this far away in x and in y.
    static int marginPx(const Prefilter& filter);
    /// (2 margin + 1)^2 pixels that a sample may reach, row by row from the top left.
    int reach() const { return reach_; }

    /// Of a sample for each pixel of the reach.
    const FixedWeight* of(std::size_t pattern, int sample) const {
        return &weights_[(pattern * samples_ + sample) * reach_];
    }
    /// Of all samples together.
    const FixedWeight* total(std::size_t pattern) const { return &totals_[pattern * reach_]; }

  private:
    int samples_, reach_;
    std::vector<FixedWeight> weights_, totals_;
};

/// As many patterns as keep the table of weights small; at least 4.
std::size_t patternCount(const Prefilter& filter, int samples);

}  // namespace edgewise
