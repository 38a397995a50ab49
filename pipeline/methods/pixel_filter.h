// From the owners of samples to pixels: each (pixel, owner) is shaded once and weighs what its samples weigh.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/aov.h"
#include "pipeline/methods/method.h"
#include "pipeline/methods/point_samples.h"
#include "pipeline/methods/sample_weights.h"
#include "pipeline/shade.h"
#include "pipeline/shading_text.h"

namespace edgewise {

/// What is seen at a sample that counts for nothing: the pixel's other samples share its weight in proportion
/// to their own. Each pixel must have a sample of a positive weight that is known.
inline constexpr Owner kUnknown = kBackground - 1;

/// The samples of a window of pixels, in rows of `stride`: a row of pixels has pattern.rows of them, a pixel
/// pattern.columns in each.
struct SampleBand {
    PixelBox window;
    std::size_t stride = 0;
    std::vector<Owner> owner;  ///< or kUnknown
    LayerStacks stacks;
    std::vector<std::uint32_t>
        run_end;               ///< the first sample of the row, at or after this one, with another owner
    std::vector<Shade> shade;  ///< where each sample is shaded where it lands
};

SampleBand makeBand(const PixelBox& window, const SamplePattern& pattern, SampledOwners sampled);

/// Samples [begin, end) of one row of a pixel's window that one owner covers.
struct OwnerRun {
    Owner owner;
    int row, begin, end;
};

/// Refers to all its arguments. The functions may be called from many threads for different pixels.
class PixelFilter {
  public:
    PixelFilter(const MethodInput& in, const Shading& shading, const AovPass& aov,
                const SampleWeights& weights, const SamplePattern& pattern);

    /// Every sample where it lands.
    void shadeSamples(SampleBand& band) const;

    /// Writes pixels [x0, x1) of a row; adds up how many (pixel, owner) were shaded.
    void filterRow(const SampleBand& band, int y, int x0, int x1, ImageBuffer& image,
                   std::atomic<std::uint64_t>& shaded) const;

    /// The owners of a pixel with their weights, in their order.
    std::vector<OwnerWeight> ownersOf(const SampleBand& band, int x, int y) const;

  private:
    using Runs = std::span<const OwnerRun>;
    void collectRuns(const SampleBand& band, int x, int y, std::vector<OwnerRun>& runs) const;
    FixedWeight weightOf(Runs runs) const;
    std::vector<OwnerWeight> ownerWeights(const std::vector<OwnerRun>& runs) const;
    std::size_t firstSample(const SampleBand& band, int x, int y, int row) const;
    std::uint64_t blend(const SampleBand& band, int x, int y, const std::vector<OwnerRun>& runs,
                        ImageBuffer& image) const;
    Shade shade(const SampleBand& band, int x, int y, Runs runs) const;
    glm::dvec2 centroidOf(const std::vector<glm::dvec2>& seen, Runs runs, glm::dvec2 corner) const;
    Shade meanOver(Owner owner, const std::vector<glm::dvec2>& seen) const;
    std::vector<glm::dvec2> spreadOut(const std::vector<glm::dvec2>& seen, std::size_t count) const;
    f64::PixelSum withHits(const f64::PixelSum& sum, const SampleBand& band, int x, int y, Runs runs,
                           double share) const;
    std::vector<glm::dvec2> seenAt(const SampleBand& band, int x, int y, Runs runs) const;
    glm::dvec2 position(const SampleBand& band, std::size_t row, std::size_t column) const;
    Shade shadeAt(const SampleBand& band, const Owner& owner, glm::dvec2 p_px) const;

    const MethodInput& in_;
    const Shading& shading_;
    const AovPass& aov_;
    const SampleWeights& weights_;
    const SamplePattern& pattern_;
    bool weighted_centroids_;
};

}  // namespace edgewise
