// Film grain: noise of a known spectrum, one number a pixel and frame.
#pragma once

#include <cstdint>

namespace edgewise {

enum class GrainSpectrum : unsigned char {
    kWhite,  ///< the same at all frequencies
    kBlue  ///< (1 - cos^2(pi u) cos^2(pi v))^2, u and v in cycles a pixel: none at 0, and flat near the limit
};

/// Mean 0, root mean square 1. White: uniform in [-sqrt 3, sqrt 3). Blue: white less its mean over the 3x3
/// binomial kernel. By pixel, frame and seed alone: crops do not show.
double grainAt(GrainSpectrum spectrum, int x, int y, std::uint64_t frame, std::uint64_t seed);

/// The spectral density at (u, v), of mean 1.
double grainDensity(GrainSpectrum spectrum, double u, double v);

}  // namespace edgewise
