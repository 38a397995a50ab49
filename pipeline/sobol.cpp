#include "pipeline/sobol.h"

namespace edgewise {

std::uint64_t mixed(std::uint64_t key) {
    std::uint64_t z = key + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

glm::u32vec2 sobolPoint(std::uint32_t index) {
    glm::u32vec2 point(0u);
    // Column k of Pascal's triangle mod 2, bit-reversed: each is the last one xor its half.
    std::uint32_t corput = 0x80000000u, pascal = 0x80000000u;
    for (; index != 0; index >>= 1) {
        if ((index & 1u) != 0) point.x ^= corput, point.y ^= pascal;
        corput >>= 1;
        pascal ^= pascal >> 1;
    }
    return point;
}

std::uint32_t owenScrambled(std::uint32_t value, std::uint64_t key) {
    std::uint32_t flips = 0;
    for (int depth = 0; depth < 32; ++depth) {
        // A node of the binary tree: the bits above, behind a one that says how many they are.
        const std::uint64_t node = ((std::uint64_t(1) << 32) | value) >> (32 - depth);
        flips |= static_cast<std::uint32_t>(mixed(key ^ mixed(node)) >> 63) << (31 - depth);
    }
    return value ^ flips;
}

}  // namespace edgewise
