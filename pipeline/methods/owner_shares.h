// What the owners of one pixel's samples weigh for the pixels around it.
#pragma once

#include <span>
#include <vector>

#include "analytic/screen_triangle.h"
#include "pipeline/methods/pattern_weights.h"

namespace edgewise {

/// The owners that a pixel's samples see, and for each its weights for all pixels of the reach.
class OwnerShares {
  public:
    explicit OwnerShares(const PatternWeights& weights) : weights_(weights) {}

    void clear();
    /// Appends a pixel; its samples' owners in the order of the pattern.
    void add(std::span<const Owner> samples, std::size_t pattern);

    /// Owners of all pixels, in the order they were added; those of pixel i are [first(i), first(i + 1)).
    std::size_t first(std::size_t pixel) const { return first_[pixel]; }
    const std::vector<Owner>& owners() const { return owners_; }
    const FixedWeight* weightsOf(std::size_t entry) const { return &shares_[entry * weights_.reach()]; }

  private:
    struct Run {
        Owner owner;
        int begin, end;
    };
    void collectRuns(std::span<const Owner> samples);

    const PatternWeights& weights_;
    std::vector<std::size_t> first_{0};
    std::vector<Owner> owners_;
    std::vector<FixedWeight> shares_;
    std::vector<Run> runs_;
    std::vector<std::span<const Run>> groups_;  ///< of one owner each
};

}  // namespace edgewise
