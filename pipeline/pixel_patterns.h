// Several patterns of samples, dealt to the pixels at random.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace edgewise {

/// All patterns have as many samples. A pixel's pattern depends on its position and the seed alone, so that
/// threads, tiles and crops do not show; neighbours' errors are independent of each other, as are those of
/// two seeds.
struct PixelPatterns {
    int samples = 1;                ///< of a pixel
    std::vector<glm::dvec2> at_px;  ///< from the pixel's corner, in [0, 1), multiples of 2^-32 px; by pattern
    std::uint64_t seed = 0;

    std::size_t count() const { return at_px.size() / samples; }
    std::size_t patternOf(int x, int y) const;
    std::span<const glm::dvec2> pattern(std::size_t i) const {
        return std::span(at_px).subspan(i * samples, samples);
    }
};

/// The first samples of `patterns` independent Owen scramblings of Sobol's sequence; each pattern's sorted
/// along a Z-order curve, so that neighbours in the list are neighbours in the pixel.
PixelPatterns sobolPatterns(int samples, std::size_t patterns, std::uint64_t seed);

}  // namespace edgewise
