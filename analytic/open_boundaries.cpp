#include "analytic/open_boundaries.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

namespace edgewise {
namespace {

std::uint64_t mixed(std::uint64_t h, double v) {
    h = (h ^ std::bit_cast<std::uint64_t>(v + 0.0)) * 0x9e3779b97f4a7c15ull;
    return h ^ (h >> 29);
}

bool onBorder(const FinePoint& p, const Window& window) {
    const auto on = [](double grid, double rest, int low, int high) {
        return rest == kBorderRestPx && (grid == low || grid == high);
    };
    return on(p.grid.x, p.rest.x, window.x0, window.x1) || on(p.grid.y, p.rest.y, window.y0, window.y1);
}

/// A number for a point: what begins and ends at one place adds up to 0.
std::uint64_t numberOf(const FinePoint& p, const Window& window) {
    if (onBorder(p, window)) return 0;
    return mixed(mixed(mixed(mixed(1, p.grid.x), p.grid.y), p.rest.x), p.rest.y);
}

}  // namespace

std::size_t openBoundaries(const VisibleMap& map, const Window& window) {
    std::unordered_map<Owner, std::uint64_t> sums;
    for (const VisibleSegment& s : map.segments) {
        const std::uint64_t step = numberOf(s.b, window) - numberOf(s.a, window);
        sums[s.left] += step, sums[s.right] -= step;
    }
    return static_cast<std::size_t>(
        std::ranges::count_if(sums, [](const auto& owner) { return owner.second != 0; }));
}

}  // namespace edgewise
