#include "paper_figures/conservative_area.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace edgewise::figures {
namespace {

void include(std::optional<RowPart>& part, double low, double high) {
    part = part ? RowPart{std::min(part->low, low), std::max(part->high, high)} : RowPart{low, high};
}

void includeDisk(std::optional<RowPart>& part, glm::dvec2 centre, double h, double y) {
    const double square = h * h - (y - centre.y) * (y - centre.y);
    if (square >= 0.0) include(part, centre.x - std::sqrt(square), centre.x + std::sqrt(square));
}

/// Where the row crosses the segment.
void includeCrossing(std::optional<RowPart>& part, glm::dvec2 a, glm::dvec2 b, double y) {
    if (std::min(a.y, b.y) > y || std::max(a.y, b.y) < y) return;
    if (a.y == b.y) return include(part, std::min(a.x, b.x), std::max(a.x, b.x));
    const double x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
    include(part, x, x);
}

/// Pixels' middles of the row in [low, high] and in the film.
std::uint64_t samplesIn(const std::optional<RowPart>& part, const PixelBox& film) {
    if (!part) return 0;
    const double first = std::max<double>(film.x0, std::ceil(part->low - 0.5)),
                 last = std::min<double>(film.x1 - 1, std::floor(part->high - 0.5));
    return last < first ? 0 : static_cast<std::uint64_t>(last - first) + 1;
}

}  // namespace

/// A capsule around each edge; what lies between them is the triangle.
std::optional<RowPart> withinReach(const Corners& triangle, double h, double y) {
    std::optional<RowPart> part;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec2 a = triangle[i], b = triangle[(i + 1) % 3];
        const glm::dvec2 along = (b - a) / glm::length(b - a), across(-along.y * h, along.x * h);
        includeDisk(part, a, h, y);
        includeCrossing(part, a + across, b + across, y);
        includeCrossing(part, a - across, b - across, y);
    }
    return part;
}

std::optional<RowPart> rowOf(const Corners& triangle, double y) {
    std::optional<RowPart> part;
    for (int i = 0; i < 3; ++i) includeCrossing(part, triangle[i], triangle[(i + 1) % 3], y);
    return part;
}

Incircle incircleOf(const Corners& p) {
    const double a = glm::length(p[2] - p[1]), b = glm::length(p[0] - p[2]), c = glm::length(p[1] - p[0]);
    const glm::dvec2 u = p[1] - p[0], v = p[2] - p[0];
    const double around = a + b + c;
    return {(a * p[0] + b * p[1] + c * p[2]) / around, std::abs(u.x * v.y - u.y * v.x) / around};
}

Corners thickened(const Corners& triangle, double h) {
    const Incircle circle = incircleOf(triangle);
    const double scale = (circle.radius + h) / circle.radius;
    Corners out;
    for (int i = 0; i < 3; ++i) out[i] = circle.centre + scale * (triangle[i] - circle.centre);
    return out;
}

GatherCounts& GatherCounts::operator+=(const GatherCounts& other) {
    needed += other.needed, thickened += other.thickened;
    clipped += other.clipped, covered += other.covered;
    return *this;
}

GatherCounts gatherCounts(const Corners& triangle, double h, const PixelBox& film) {
    const Corners large = thickened(triangle, h);
    const auto lowest = [](const Corners& t) { return glm::min(glm::min(t[0], t[1]), t[2]); };
    const auto highest = [](const Corners& t) { return glm::max(glm::max(t[0], t[1]), t[2]); };
    const glm::dvec2 low = lowest(triangle) - h, high = highest(triangle) + h;
    GatherCounts counts;
    const double y0 = std::clamp<double>(std::floor(lowest(large).y), film.y0, film.y1),
                 y1 = std::clamp<double>(std::ceil(highest(large).y), film.y0, film.y1);
    for (int j = static_cast<int>(y0); j < static_cast<int>(y1); ++j) {
        const double y = j + 0.5;
        counts.needed += samplesIn(withinReach(triangle, h, y), film);
        counts.covered += samplesIn(rowOf(triangle, y), film);
        const std::optional<RowPart> row = rowOf(large, y);
        counts.thickened += samplesIn(row, film);
        if (row && y >= low.y && y <= high.y)
            counts.clipped +=
                samplesIn(RowPart{std::max(row->low, low.x), std::min(row->high, high.x)}, film);
    }
    return counts;
}

}  // namespace edgewise::figures
