// The exact orientation of points on the screen's grid of 2^-32 px.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>

namespace edgewise {

/// The sign of cross(b - a, c - a): the differences are exact in double, two products of 53 bits and their
/// difference fit 128 bits; a filter answers nearly always (two products and a difference, each off by at
/// most u = 2^-53).
inline int gridOrientation(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    const glm::dvec2 u = b - a, v = c - a;
    const double left = u.x * v.y, right = u.y * v.x, cross = left - right;
    if (std::fabs(cross) > 0x1p-51 * (std::fabs(left) + std::fabs(right))) return cross > 0.0 ? 1 : -1;
    __extension__ using Wide = __int128;
    auto grid = [](double x) { return static_cast<Wide>(static_cast<std::int64_t>(x * 0x1p32)); };
    const Wide exact_left = grid(u.x) * grid(v.y), exact_right = grid(u.y) * grid(v.x);
    return exact_left == exact_right ? 0 : (exact_left > exact_right ? 1 : -1);
}

}  // namespace edgewise
