#include "analytic/shared_edges.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace edgewise {
namespace {

/// Whether the segment a -> b may meet the cell.
bool mayMeet(glm::dvec2 a, glm::dvec2 b, const Cell& cell) {
    if (std::max(a.x, b.x) <= cell.min.x || std::min(a.x, b.x) > cell.max.x) return false;
    if (std::max(a.y, b.y) <= cell.min.y || std::min(a.y, b.y) > cell.max.y) return false;
    const glm::dvec2 e = b - a, c = 0.5 * (cell.min + cell.max) - a, h = 0.5 * (cell.max - cell.min);
    const double middle = e.x * c.y - e.y * c.x;
    const double reach = std::abs(e.x) * h.y + std::abs(e.y) * h.x;
    const double slack = (std::abs(e.x) + std::abs(e.y)) * (2.0 * kBorderRestPx) +
                         4.0 * 0x1p-53 * (std::abs(e.x * c.y) + std::abs(e.y * c.x) + reach);
    return std::abs(middle) <= reach + slack;
}

bool runsCanonically(glm::dvec2 a, glm::dvec2 b) {
    return a.y < b.y || (a.y == b.y && a.x > b.x);
}

}  // namespace

void SharedEdges::enter(const ScreenScene& scene, std::uint32_t triangle, std::uint32_t k,
                        std::uint32_t place) {
    const ScreenTriangle& t = scene.triangles[triangle];
    const std::uint32_t u = t.vertex[k], v = t.vertex[(k + 1) % 3];
    const std::uint64_t ends = (static_cast<std::uint64_t>(std::min(u, v)) << 32) | std::max(u, v);
    const std::size_t room = slots_.size() - 1;
    std::size_t slot = (ends * 0x9e3779b97f4a7c15ull >> 17) & room;
    while (slots_[slot] != 0 && edges_[slots_[slot] - 1].ends != ends) slot = (slot + 1) & room;
    const bool canonical = runsCanonically(t.p_px[k], t.p_px[(k + 1) % 3]);
    if (slots_[slot] == 0) {
        edges_.push_back({ends, LineRef::edge(triangle, k)});
        slots_[slot] = static_cast<std::uint32_t>(edges_.size());
    }
    SharedEdge& edge = edges_[slots_[slot] - 1];
    std::uint32_t& side = canonical ? edge.with : edge.against;
    if (side != SharedEdge::kUnused) {
        surplus_[place] = 1, any_surplus_ = true;
        return;
    }
    side = place;
    edge.canonical = std::min(edge.canonical, LineRef::edge(triangle, k));
}

void SharedEdges::collect(const ScreenScene& scene, const Cell& cell,
                          std::span<const std::uint32_t> triangles) {
    edges_.clear();
    slots_.assign(std::bit_ceil(4 * triangles.size() + 4), 0);
    surplus_.assign(triangles.size(), 0), any_surplus_ = false;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const auto& p = scene.triangles[triangles[i]].p_px;
        for (std::uint32_t k = 0; k < 3; ++k)
            if (mayMeet(p[k], p[(k + 1) % 3], cell)) enter(scene, triangles[i], k, i);
    }
}

bool SharedEdges::allPaired() const {
    return !any_surplus_ && std::ranges::all_of(edges_, [](const SharedEdge& e) {
        return e.with != SharedEdge::kUnused && e.against != SharedEdge::kUnused;
    });
}

int sideOfTriangle(const ScreenTriangle& t, glm::dvec2 p) {
    double smallest = HUGE_VAL, error = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.p_px[k], e = t.p_px[(k + 1) % 3] - a, d = p - a;
        const double x = e.x * d.y, y = e.y * d.x;
        if (x - y < smallest) smallest = x - y, error = 3.0 * 0x1p-53 * (std::abs(x) + std::abs(y));
    }
    return std::abs(smallest) <= error ? 0 : smallest > 0.0 ? 1 : -1;
}

std::array<glm::dvec2, 2> genericPoints(const Cell& cell) {
    const glm::dvec2 size = cell.max - cell.min;
    return {cell.min + size * glm::dvec2(0.5078125, 0.4765625),
            cell.min + size * glm::dvec2(0.2734375, 0.6171875)};
}

}  // namespace edgewise
