#include "pipeline/path_sampler.h"

#include "pipeline/sobol.h"

namespace edgewise {
namespace {

std::uint32_t reversed(std::uint32_t bits) {
    bits = ((bits >> 1) & 0x55555555u) | ((bits & 0x55555555u) << 1);
    bits = ((bits >> 2) & 0x33333333u) | ((bits & 0x33333333u) << 2);
    bits = ((bits >> 4) & 0x0f0f0f0fu) | ((bits & 0x0f0f0f0fu) << 4);
    return __builtin_bswap32(bits);
}

}  // namespace

PixelPathSampler::PixelPathSampler(int x, int y, std::uint64_t seed)
    : key_(mixed(mixed(seed) ^
                 ((std::uint64_t(static_cast<std::uint32_t>(y)) << 32) | static_cast<std::uint32_t>(x)))) {}

glm::dvec2 PixelPathSampler::point(std::uint32_t index) const {
    const std::uint64_t key = mixed(key_ + index);
    const std::uint32_t order = reversed(owenScrambled(reversed(sample_), key));
    const glm::u32vec2 plain = sobolPoint(order);
    return glm::dvec2(owenScrambled(plain.x, mixed(key + 1)), owenScrambled(plain.y, mixed(key + 2))) * 0x1p-32;
}

}  // namespace edgewise
