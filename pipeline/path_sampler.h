// Numbers for paths: Owen-scrambled Sobol points, padded to as many coordinates as a path takes.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "sdf/path_tracer.h"

namespace edgewise {

/// Every pair of coordinates is the (0, 2)-sequence of pipeline/sobol.h in an order and under a scrambling of
/// its own (both nested uniform, so that the first 2^k samples take an aligned block of the sequence and are
/// a net in each pair), by pixel and seed alone: threads and crops do not show.
class PixelPathSampler : public sdf::PathSampler {
  public:
    PixelPathSampler(int x, int y, std::uint64_t seed);
    void start(std::uint32_t sample) { sample_ = sample; }
    /// Pair 0 of a sample: where it lies in its pixel. A path's own pairs begin after it.
    glm::dvec2 position() const { return point(0); }
    glm::dvec2 pair(std::uint32_t index) override { return point(index + 1); }

  private:
    glm::dvec2 point(std::uint32_t index) const;

    std::uint64_t key_;
    std::uint32_t sample_ = 0;
};

}  // namespace edgewise
