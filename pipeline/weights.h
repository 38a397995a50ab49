// Weights: the visible map and a prefilter become, for every pixel, the weight of each owner (NSAA
// section 3.2).
#pragma once

#include <span>
#include <vector>

#include "analytic/pixel_weights.h"
#include "pipeline/film.h"
#include "pipeline/scan.h"
#include "pipeline/shading_points.h"

namespace edgewise {

/// Owners that shade alike are one: representative[owner]; empty: every triangle stands for itself. Stacks go
/// by the names that ofMap() gave them.
struct OwnerClasses {
    std::vector<Owner> representative;
    std::vector<Owner> stack_name;
    Owner of(Owner owner) const {
        if (owner == kBackground) return owner;
        if (isStack(owner)) return stack_name[owner - kFirstStack];
        return representative.empty() ? owner : representative[owner];
    }

    /// These classes for the stacks of a map too: stacks whose layers shade alike are one, named by the
    /// layers' representatives in `named`. So their order knows nothing of the map's other stacks.
    OwnerClasses ofMap(const LayerStacks& stacks, LayerStacks& named) const;
};

/// Owner weights of the pixels of one box, pixel by pixel in rows: entries[offset[p]] .. entries[offset[p +
/// 1]].
struct WeightTile {
    PixelBox box;
    std::vector<std::size_t> offset;
    std::vector<OwnerWeight> entries;
    ShadingPoints points;  ///< by entry
};

struct WeightOptions {
    bool skip_interior = true;    ///< a support without segments: the point's owner has it all
    bool skip_cancelling = true;  ///< a segment between owners of one class is not integrated
    Precision precision = Precision::kFp64;
    ShadingChoice shading;  ///< what WeightTile::points are wanted for
};

/// One thread's part of the stage.
class WeightWorker {
  public:
    WeightWorker(const Prefilter& filter, const WeightOptions& options);

    /// The weights of `box`, given the segments (ids into map.segments) that may touch a support in it.
    /// Samples lie at (i + 0.5, j + 0.5) + offset_px, where offset_px is whole pixels.
    void run(const VisibleMap& map, std::span<const std::uint32_t> segments, const OwnerClasses& classes,
             const PixelBox& box, glm::dvec2 offset_px, WeightTile& out);

    std::uint64_t terms() const { return weights_.terms(); }
    std::uint64_t labelConflicts() const { return weights_.label_conflicts(); }
    std::uint64_t interiorPixels() const { return interior_pixels_; }

  private:
    struct Edge {
        EdgeInput input;
        std::uint32_t segment;
        Owner left, right;
    };
    struct Span {
        std::uint32_t edge;
        double x0, x1;  ///< of the part within reach of the row
    };
    void collectRows(const VisibleMap& map, std::span<const std::uint32_t> segments,
                     const OwnerClasses& classes, const PixelBox& box, double offset_y_px);
    void runGroup(const VisibleMap& map, const OwnerClasses& classes, std::span<const Span> spans,
                  glm::dvec2 first, int row, int count, const Owner* base, WeightTile& out);
    void beginGroup(glm::dvec2 first, int count);

    double radius_;
    WeightOptions options_;
    PixelWeights weights_;
    ShadingPointFinder points_;
    std::vector<Edge> edges_;              ///< of the tile
    std::vector<std::vector<Span>> rows_;  ///< of the tile, from its top
    std::uint64_t interior_pixels_ = 0;
};

/// Pixel boxes of `tile_px` that tile `box`, row by row, and the segments within reach of each.
inline constexpr int kWeightTilePx = 32;
struct WeightTiles {
    std::vector<PixelBox> boxes;
    IdLists segments;
};
WeightTiles gatherSegments(const VisibleMap& map, const PixelBox& box, glm::dvec2 offset_px, double radius,
                           int tile_px = kWeightTilePx);

}  // namespace edgewise
