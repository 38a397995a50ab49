// The closed-form prefilter weights of the owners around samples: visible segments in, one weight an owner
// out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "analytic/lane_kernel.h"
#include "analytic/owner_weight.h"
#include "analytic/precision.h"
#include "analytic/prefilter.h"
#include "analytic/visible_segment.h"

namespace edgewise {

/// Samples first .. last of a row; none where last < first.
struct LaneRange {
    int first, last;

    /// Those of `count` that lie within [low, high], px from the first.
    static LaneRange within(double low, double high, int count) {
        const double from = std::max(0.0, low), to = std::min(count - 1.0, high);
        const int first = static_cast<int>(from);  // no std::ceil: a call on machines without SSE 4
        return {first + (first < from), to < 0.0 ? -1 : static_cast<int>(to)};
    }
};

/// Weights of up to kLanes samples at first + (i, 0) px.  begin(), add() every segment that may touch a
/// support (within 2^-30 px: a border needs all segments of a vertex on it, not some), finish().  The result
/// does not depend on the order of add(), nor on which samples share a call.
class PixelWeights {
  public:
    static constexpr int kLanes = 32;

    explicit PixelWeights(const Prefilter& filter, Precision precision = Precision::kFp64);
    ~PixelWeights();
    PixelWeights(const PixelWeights&) = delete;
    PixelWeights& operator=(const PixelWeights&) = delete;

    void begin(glm::dvec2 first_sample_px, int count);

    /// `left` and `right` replace the segment's owners (the caller may merge owners that shade alike).
    void add(const VisibleSegment& segment, const CarrierLine& line, Owner left, Owner right);
    /// The same where the caller knows what samples' supports it may touch, likewise within 2^-30 px. The
    /// edge is read until finish() returns.
    void add(const EdgeInput& edge, Owner left, Owner right, LaneRange lanes);

    /// base_owner[i] owns the point (sample.x + R + 0, sample.y), where the support's border lies: it is
    /// asked only when nothing certainly changes hands on that border and no segment comes within 2^-31 px of
    /// the point.  Writes sample i's owners in ascending order to out[offset[i]..offset[i + 1]); owners of
    /// weight exactly 0 are left out; the weights of a sample sum to exactly 2^60.
    void finish(const Owner* base_owner, std::vector<OwnerWeight>& out, std::size_t* offset);

    /// Terms evaluated since construction: (segment, sample) pairs whose support meets the segment.
    std::uint64_t terms() const;
    /// Samples on whose border some owner is not left as often as it is entered: 0 on a closed map.
    std::uint64_t label_conflicts() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace edgewise
