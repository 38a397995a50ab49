// Lines through points of the screen's grid that pass a point of it at a distance chosen to 2^-66 px: far
// below the grid's own step, which rounding two ends could not reach.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

namespace edgewise::judge {

/// A primitive direction (p, q) in grid steps: coprime, p odd, p^2 + q^2 = h^2.
struct GridDirection {
    std::int64_t p = 1, q = 0, h = 1;
};

/// p = m^2 - n^2, q = 2 m n, h = m^2 + n^2 for coprime m > n > 0 of opposite parity (others are moved to the
/// next such pair). m, n < 2^18: a step along the line is a few px.
GridDirection pythagorean(std::int64_t m, std::int64_t n);

/// Two grid points relative to the origin, at least `reach_px` along the line either way of its foot, with
/// cross((p, q), a) = c exactly: the line's distance from the origin is |c| / h steps of the grid, and (p, q)
/// points from a to b. |c| < 2^72.
__extension__ typedef __int128 WideSteps;
std::array<glm::dvec2, 2> lineAtOffset(const GridDirection& direction, WideSteps c, double reach_px);

}  // namespace edgewise::judge
