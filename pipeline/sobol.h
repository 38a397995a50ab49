// The first two dimensions of Sobol's sequence, and Owen's scrambling of one coordinate.
#pragma once

#include <cstdint>
#include <glm/ext/vector_uint2_sized.hpp>

namespace edgewise {

/// A well mixed 64-bit number: one step of SplitMix64 (Steele, Lea and Flood 2014, "Fast splittable
/// pseudorandom number generators"). A bijection.
std::uint64_t mixed(std::uint64_t key);

/// Point `index` of the sequence, in units of 2^-32: a (0, 2)-sequence in base 2 (Sobol 1967). The first
/// coordinate is van der Corput's, the second has the generator matrix of Pascal's triangle modulo 2.
glm::u32vec2 sobolPoint(std::uint32_t index);

/// Owen's nested uniform scrambling (Owen 1995, "Randomly permuted (t, m, s)-nets and (t, s)-sequences"):
/// each bit is flipped or not by a coin of its own for every value of the bits above it. The coins are hashes
/// of the key and those bits. A bijection, which leaves as many points as before in every interval
/// [a, a + 1) 2^-k: what was a (0, 2)-sequence still is one. Each point is uniform in [0, 1).
std::uint32_t owenScrambled(std::uint32_t value, std::uint64_t key);

}  // namespace edgewise
