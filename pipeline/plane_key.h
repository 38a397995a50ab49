// A key that exactly equal planes share: the plane's coefficients as residues modulo the prime 2^61 - 1.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace edgewise {

/// For each triangle its plane's coefficients, divided by the first that is not 0, in the field of 2^61 - 1,
/// hashed. A float is m 2^e and 2 has an inverse there, so the arithmetic is exact: equal planes have equal
/// keys, whichever triangle they came from; different planes collide with probability about 2^-61. None: all
/// three components of the normal are multiples of the prime (no area, or one plane in 2^183).
std::vector<std::optional<std::uint64_t>> planeKeys(std::span<const std::array<glm::vec3, 3>> triangles);

}  // namespace edgewise
