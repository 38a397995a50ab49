#include "sdf/pattern_point.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace edgewise::sdf {

glm::dvec3 patternPoint(const glm::dvec3& p_world, const glm::dvec3& outward, double height, double t) {
    constexpr double kRoundings = 512.0 * 0x1p-53;
    const double depth = kRoundings * (glm::length(p_world) + std::abs(t));
    return p_world - outward * (2.0 * std::max(height, 0.0) + depth);
}

double describeHit(const TapeView& tape, SurfaceHit& hit, std::size_t materials) {
    const auto [value, gradient] = gradientAt(tape, hit.p_world);
    const double slope = glm::length(gradient);
    const bool sloped = slope > 0.0 && std::isfinite(slope);
    if (std::isnan(hit.value)) hit.value = value;
    const double height = sloped ? value / slope : 0.0;
    hit.height = height;
    hit.normal_world = sloped ? gradient / slope : glm::dvec3(0.0, 1.0, 0.0);
    const Instruction& winner = winnerAt(tape, hit.p_world, hit.p_local);
    hit.p_local = localAt(tape, winner, patternPoint(hit.p_world, hit.normal_world, height, hit.t));
    hit.material = std::min(winner.material, static_cast<std::uint32_t>(materials - 1));
    return height;
}

}  // namespace edgewise::sdf
