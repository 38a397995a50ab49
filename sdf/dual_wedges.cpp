#include "sdf/dual_wedges.h"

#include <algorithm>
#include <cmath>

#include "sdf/inward_way.h"

namespace edgewise::sdf {
namespace {

/// Of a cell's side: a wedge gets thick within so far, which refinement then reaches.
constexpr double kLongest = 2.0;
constexpr int kMostSteps = 200;

}  // namespace

std::size_t WedgeCorners::turnIn(const Brick& brick, BrickCrossings& crossings) const {
    if (!request_.bound_holds) return 0;
    const double cell = request_.lattice.step / (1 << brick.level);
    constexpr int kSide = BrickCrossings::kSide;
    std::size_t count = 0;
    for (int n = 0; n < BrickCrossings::kCorners; ++n) {
        const glm::ivec3 place(n % kSide, n / kSide % kSide, n / (kSide * kSide));
        const double value = crossings.value(place);
        if (std::abs(value) < 0.5 * cell * request_.tape.lipschitz && isThin(brick.unitsOf(place), value))
            crossings.turn(place), ++count;
    }
    return count;
}

double WedgeCorners::valueAt(const glm::ivec3& unit) const {
    const glm::dvec3 p = request_.lattice.corner(unit);
    const double value = sdf::valueAt(tape_(p), p);
    const bool thin = request_.bound_holds && isThin(unit, value);
    return !thin ? value : value < 0.0 ? -value : -std::max(value, 1e-300);
}

bool WedgeCorners::isThin(const glm::ivec3& unit, double value) const {
    const glm::dvec3 p = request_.lattice.corner(unit);
    const double cell = finestAround(unit);
    const bool solid = value < 0.0;
    const glm::dvec3 gradient = gradientAt(tape_(p), p).gradient;
    const double slope = glm::length(gradient), depth = std::abs(value) / slope;
    if (!(slope > 0.0) || !(depth < 0.5 * cell)) return false;
    const glm::dvec3 beyond = p + (solid ? -1.0 : 1.0) * (cell - depth) / slope * gradient;
    if ((sdf::valueAt(tape_(beyond), beyond) < 0.0) == solid) return false;
    InwardWay way(tape_, request_.tape.lipschitz, p, solid);
    for (int n = 0; n < kMostSteps && way.length() < kLongest * cell && way.isOn(); ++n, way.step())
        if (way.reach() >= 0.5 * cell) return true;
    return false;
}

double WedgeCorners::finestAround(const glm::ivec3& unit) const {
    if (bricks_.parts.empty()) return request_.lattice.step;
    int level = 0;
    for (int n = 0; n < 8; ++n) {
        const glm::ivec3 at = unit - glm::ivec3(n & 1, n >> 1 & 1, n >> 2 & 1);
        level = std::max(level, bricks_.leafAt(request_.lattice, at).level);
    }
    return request_.lattice.step / (1 << level);
}

}  // namespace edgewise::sdf
