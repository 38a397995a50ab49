// The front-most owner at exact sample positions: what the sampling methods see.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "analytic/layer_stacks.h"
#include "pipeline/film.h"
#include "pipeline/sample_pattern.h"

namespace edgewise {

/// Owners of samples: triangles, stacks of see-through layers, or the background.
struct SampledOwners {
    std::vector<Owner> owner;
    LayerStacks stacks;  ///< sorted: the same for any threads
};

/// Stacks come by threads: their names are exchanged for those of the sorted table.
void sortStacks(SampledOwners& sampled);

/// Looks up samples of one projected scene. Every decision is exact:
/// inside by the orientation of grid points, a point on an edge belonging to the triangle whose top or left
/// edge it is, so that each point of a shared edge has one owner; nearer by the sign of the depth planes'
/// difference; equal depth to the lower index.
class PointSampler {
  public:
    /// K x K samples a pixel, for pixels of `box`.
    PointSampler(const ScreenScene& scene, const PixelBox& box, int per_side);

    /// Owners of all samples of a window within the box, in rows of width() * K from the top, each sample
    /// moved by `shift_px`, a multiple of the grid that leaves it in its pixel. Parallel by tiles. Throws
    /// FailureError naming the pixel where a sample has more than kMostLayers layers.
    SampledOwners sample(const PixelBox& window, glm::dvec2 shift_px = glm::dvec2(0.0)) const;

    /// Depth decisions that the rounded planes left open.
    std::uint64_t exactDepths() const { return exact_depths_; }

  private:
    friend class TileSampler;
    PixelBox tileBox(std::size_t tile) const;
    void binTriangles();
    template <class Visit>
    void visitTiles(const ScreenTriangle& triangle, const Visit& visit) const;

    const ScreenScene& scene_;
    PixelBox box_;
    int per_side_;
    int tile_px_;
    int tiles_x_, tiles_y_;
    std::vector<std::size_t> first_;     ///< by tile, into binned_
    std::vector<std::uint32_t> binned_;  ///< triangles of each tile, ascending
    mutable std::atomic<std::uint64_t> exact_depths_{0};
    mutable std::mutex stacks_mutex_;
};

}  // namespace edgewise
