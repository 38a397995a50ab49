// Where the owners around a sample are shaded, when that is not the closest point: --shading centroid and
// samples:N of the analytic method.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "analytic/first_moments.h"
#include "analytic/owner_table.h"
#include "analytic/pixel_weights.h"
#include "pipeline/methods/method.h"

namespace edgewise {

/// By entry of a WeightTile: offsets from the pixel's sample, px, on the grid of 2^-32 px, so that adding
/// whole pixels moves them exactly. An entry without points is shaded at the closest point.
struct ShadingPoints {
    std::vector<std::size_t> end;  ///< by entry; empty: no entry has points
    std::vector<glm::dvec2> offset_px;

    void clear() { end.clear(), offset_px.clear(); }
    std::span<const glm::dvec2> of(std::size_t entry) const {
        if (end.empty()) return {};
        const std::size_t begin = entry == 0 ? 0 : end[entry - 1];
        return std::span(offset_px).subspan(begin, end[entry] - begin);
    }
};

/// centroid   The centroid of what the support shows of the owner: weighted by the filter where that is
/// radial
///            and nowhere negative, else of the area [E17]. An owner of less than 2^-32 of the weight, whose
///            centroid would be rounding, is shaded at the closest point.
/// samples:N  Up to N points where the support shows the owner: of the Halton sequence in bases 2 and 3 over
///            the support's square, cut to the disk of radial filters, the first kTriesPerPoint N are tried.
///            An owner that none of them meets is shaded at its centroid.
/// Same points whatever the order of add(), the threads, tiles and crops.
class ShadingPointFinder {
  public:
    static constexpr int kTriesPerPoint = 16;
    static constexpr int kLanes = OwnerTable::kLanes;

    ShadingPointFinder(const Prefilter& filter, const ShadingChoice& choice);

    /// Whether the choice needs points at all.
    bool active() const { return centroid_ || samples_ > 0; }

    /// Samples at first + (i, 0) px, i < count <= kLanes; then every segment that may touch a support.
    void begin(glm::dvec2 first_sample_px, int count);
    void add(const VisibleSegment& segment, const CarrierLine& line, Owner left, Owner right);

    /// The owner just right of (x_px, the samples' ordinate).
    using RowOwner = std::function<Owner(double x_px)>;

    /// Adds the points of the entries [offset[i], offset[i + 1]) of each sample i. `base_owner` is that of
    /// PixelWeights::finish().
    void finish(const Owner* base_owner, const RowOwner& row, const std::vector<OwnerWeight>& entries,
                const std::size_t* offset, ShadingPoints& out);

    /// Adds the points of a sample whose whole support one owner has.
    void whole(ShadingPoints& out) const;

  private:
    struct Edge {
        glm::dvec2 a, b;  ///< from the first sample, px; a.x < b.x
        Owner above, below;
    };
    void addEdge(const VisibleSegment& segment, Owner left, Owner right);
    void measure(const Owner* base_owner);
    FixedWeight measured(const OwnerWeight& entry, int lane) const;
    std::optional<glm::dvec2> centroid(const OwnerWeight& entry, int lane);
    Owner ownerAt(glm::dvec2 from_first, const RowOwner& row) const;
    void collectSamples(int lane, const RowOwner& row, std::span<const OwnerWeight> entries);

    bool centroid_ = false;
    int samples_ = 0;
    double radius_;
    FirstMoments moments_;
    std::unique_ptr<PixelWeights> area_;  ///< none: the weights themselves are the moments' measure
    std::vector<glm::dvec2> candidates_;

    glm::dvec2 first_{0.0};
    int count_ = 0;
    OwnerTable moment_x_, moment_y_;  ///< units of R 2^-60
    std::vector<Edge> edges_;
    std::vector<OwnerWeight> area_entries_;
    std::size_t area_offset_[kLanes + 1] = {};
    std::vector<std::vector<glm::dvec2>> found_;  ///< by entry of one sample
};

}  // namespace edgewise
