// --aov: what else is known of a pixel, as channels of the EXR.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "pipeline/aov_names.h"
#include "pipeline/cryptomatte.h"
#include "pipeline/image_buffer.h"
#include "pipeline/shade.h"
#include "pipeline/weights.h"

namespace edgewise {

struct Progress;
struct SampledOwners;

/// Fills the AOVs of one picture; refers to all its arguments. The fill functions may be called from many
/// threads for different pixels.
class AovPass {
  public:
    AovPass(const std::set<Aov>& wanted, const Scene& scene, const ResolvedCamera& camera, const Film& film,
            const ScreenScene& screen, const ScreenPieces& pieces, const Shading& shading);

    /// Whether somebody must call pixel() or tile().
    bool weighs() const { return wants(Aov::kOwners) || wants(Aov::kCryptomatte); }
    bool pointSamples() const { return wants(Aov::kDepth) || wants(Aov::kNormal) || wants(Aov::kIndex); }

    /// Makes the channels of the whole image.
    void begin(ImageBuffer& image) const;

    /// Looks up the owner at each pixel's sample and fills the point-sampled channels. Throws Interrupted.
    void samplePoints(Progress& progress, ImageBuffer& image) const;

    /// The same from owners looked up already, one a pixel of the image.
    void points(const SampledOwners& sampled, ImageBuffer& image) const;

    /// From the pixel's owners, each standing for itself. A layer of a stack covers its share of it: its
    /// alpha times what the layers before it let through.
    void pixel(int x, int y, std::span<const OwnerWeight> owners, const LayerStacks& stacks,
               ImageBuffer& image) const;
    void tile(const WeightTile& tile, const LayerStacks& stacks, ImageBuffer& image) const;

    /// Pixels where a Cryptomatte layer had more ids than ranks.
    std::uint64_t truncatedPixels() const { return truncated_; }

  private:
    bool wants(Aov aov) const { return wanted_.contains(aov); }
    Owner frontLayer(std::span<const Owner> layers, glm::dvec2 p_px) const;
    void addLayers(std::span<const Owner> layers, FixedWeight weight, glm::dvec2 p_px,
                   std::vector<OwnerWeight>& out) const;
    void point(int x, int y, std::span<const Owner> layers, ImageBuffer& image) const;
    double depthAt(Owner owner, glm::dvec2 p_px) const;
    glm::dvec3 normalAt(Owner owner, glm::dvec2 p_px) const;

    std::set<Aov> wanted_;
    const Scene& scene_;
    const Camera& camera_;
    glm::dmat4 camera_from_world_;
    glm::dvec2 offset_px_;
    const ScreenScene& screen_;
    const ScreenPieces& pieces_;
    const Shading& shading_;
    std::vector<CryptomatteLayer> layers_;
    mutable std::atomic<std::uint64_t> truncated_{0};
};

}  // namespace edgewise
