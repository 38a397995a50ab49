// Where the samples of a pixel lie.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace edgewise {

/// Sample (a, b) of a pixel lies at ((a + 1/2)/K, (b + 1/2)/K), rounded to the grid of 2^-32 px where K is no
/// power of 2.
double sampleOffsetPx(int a, int per_side);

/// The same samples in every pixel.
struct SamplePattern {
    int columns = 1, rows = 1;      ///< of samples a pixel: K x K of a lattice, N x 1 of any others
    std::vector<glm::dvec2> at_px;  ///< from the pixel's corner, in [0, 1), row by row
    int cells = 1;                  ///< a side of a division of the pixel that has no two samples in a cell
    bool lattice = true;            ///< all pixels' samples together are one regular lattice

    int size() const { return columns * rows; }
};

/// K x K samples.
SamplePattern latticePattern(int per_side);

/// Vulkan's standard sample locations for N = 2, 4, 8 or 16 samples, in the order of the sample's number;
/// multiples of 1/16 px.
SamplePattern standardPattern(int samples);

}  // namespace edgewise
