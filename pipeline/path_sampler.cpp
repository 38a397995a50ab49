#include "pipeline/path_sampler.h"

#include "pipeline/sobol.h"

namespace edgewise {
PixelPathSampler::PixelPathSampler(int x, int y, std::uint64_t seed)
    : key_(mixed(mixed(seed) ^
                 ((std::uint64_t(static_cast<std::uint32_t>(y)) << 32) | static_cast<std::uint32_t>(x)))) {}

glm::dvec2 PixelPathSampler::point(std::uint32_t index) const {
    const std::uint64_t key = mixed(key_ + index);
    const std::uint32_t order = owenScrambled(sample_, key);
    const glm::u32vec2 plain = sobolPoint(order);
    return glm::dvec2(owenScrambled(plain.x, mixed(key + 1)), owenScrambled(plain.y, mixed(key + 2))) *
           0x1p-32;
}

}  // namespace edgewise
