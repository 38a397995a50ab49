// Frames of one picture: their mean, and how they differ.
#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "pipeline/image_buffer.h"

namespace edgewise {

/// Sums of the frames so far, pixel by pixel.
class TemporalMean {
  public:
    void add(std::span<const glm::dvec4> frame);
    std::uint64_t frames() const { return frames_; }
    glm::dvec4 mean(std::size_t pixel) const { return sum_[pixel] / static_cast<double>(frames_); }
    /// From frame to frame, a channel; 0 with one frame.
    glm::dvec3 deviation(std::size_t pixel) const;
    /// The root mean square over pixels and channels.
    double deviation() const;
    /// Of the mean of all frames, likewise: half the difference of the means over even and odd frames, which
    /// sees that low-discrepancy frames make up for each other. 0 with fewer than two frames.
    double deviationOfMean() const;

  private:
    std::uint64_t frames_ = 0;
    std::vector<glm::dvec4> sum_, squares_, even_;
};

}  // namespace edgewise
