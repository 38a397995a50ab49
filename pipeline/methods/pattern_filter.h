// From the owners at samples of pixels that have patterns of their own to pixels.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "pipeline/aov.h"
#include "pipeline/methods/method.h"
#include "pipeline/methods/pattern_weights.h"
#include "pipeline/methods/point_samples.h"
#include "pipeline/shade.h"

namespace edgewise {

/// Each (pixel, owner) is shaded once, unless samples are shaded where they land, and weighs what its samples
/// weigh. Refers to all its arguments.
class PatternFilter {
  public:
    PatternFilter(const MethodInput& in, const Shading& shading, const AovPass& aov,
                  const PixelPatterns& patterns, const PatternWeights& weights);

    /// Filters a box's pixels from the owners at the samples of `window`, the box grown by the filter's
    /// margin. Adds up how many (pixel, owner) were shaded. Throws InputError naming a pixel whose samples'
    /// weights do not sum to more than 0, FailureError where a weight could exceed 7.
    void filter(const PixelBox& box, const PixelBox& window, const SampledOwners& sampled, ImageBuffer& image,
                std::atomic<std::uint64_t>& shaded) const;

  private:
    friend class PatternTile;
    const MethodInput& in_;
    const Shading& shading_;
    const AovPass& aov_;
    const PixelPatterns& patterns_;
    const PatternWeights& weights_;
    int margin_px_;
    bool weighted_centroids_;
};

}  // namespace edgewise
