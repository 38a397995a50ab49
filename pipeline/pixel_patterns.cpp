#include "pipeline/pixel_patterns.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "pipeline/sobol.h"

namespace edgewise {
namespace {

/// Bits of x at even places.
std::uint64_t spread(std::uint32_t x) {
    std::uint64_t z = x;
    z = (z | (z << 16)) & 0x0000ffff0000ffffu;
    z = (z | (z << 8)) & 0x00ff00ff00ff00ffu;
    z = (z | (z << 4)) & 0x0f0f0f0f0f0f0f0fu;
    z = (z | (z << 2)) & 0x3333333333333333u;
    return (z | (z << 1)) & 0x5555555555555555u;
}

std::uint64_t zOrder(glm::u32vec2 p) {
    return spread(p.x) | (spread(p.y) << 1);
}

std::vector<glm::u32vec2> scrambledPoints(int samples, std::uint64_t key) {
    std::vector<glm::u32vec2> points;
    for (int i = 0; i < samples; ++i) {
        const glm::u32vec2 plain = sobolPoint(i);
        points.emplace_back(owenScrambled(plain.x, mixed(key)), owenScrambled(plain.y, mixed(~key)));
    }
    std::ranges::sort(points, {}, zOrder);
    return points;
}

}  // namespace

std::size_t PixelPatterns::patternOf(int x, int y) const {
    const std::uint64_t pixel =
        (std::uint64_t(static_cast<std::uint32_t>(y)) << 32) | static_cast<std::uint32_t>(x);
    return mixed(mixed(seed) ^ pixel) % count();
}

PixelPatterns sobolPatterns(int samples, std::size_t patterns, std::uint64_t seed) {
    PixelPatterns out{samples, std::vector<glm::dvec2>(samples * patterns), seed};
    tbb::parallel_for(std::size_t(0), patterns, [&](std::size_t p) {
        const auto points = scrambledPoints(samples, mixed(seed) + 2 * p);
        for (int i = 0; i < samples; ++i) out.at_px[p * samples + i] = glm::dvec2(points[i]) * 0x1p-32;
    });
    return out;
}

}  // namespace edgewise
