// A key that exactly equal planes share: the plane's coefficients as residues modulo the prime 2^61 - 1.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

namespace edgewise {

/// The plane through a, b, c: its coefficients, divided by the first that is not 0, in the field of 2^61 - 1, hashed.
/// A float is m 2^e and 2 has an inverse there, so the arithmetic is exact: equal planes have equal keys, whichever
/// triangle they came from; different planes collide with probability about 2^-61.
/// None: all three components of the normal are multiples of the prime (no area, or one plane in 2^183).
std::optional<std::uint64_t> planeKey(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

}  // namespace edgewise
