#include "pipeline/methods/polygon_weights.h"

#include <algorithm>
#include <cmath>

#include "analytic/carrier.h"
#include "analytic/edge_input.h"
#include "sdf/film_line.h"

namespace edgewise {
namespace {

constexpr Owner kInner = 0;

/// On the grid, each corner once.
std::vector<glm::dvec2> onGrid(std::span<const glm::dvec2> polygon) {
    std::vector<glm::dvec2> corners;
    for (const glm::dvec2& p : polygon) {
        const glm::dvec2 q = glm::round(p * 0x1p32) * 0x1p-32;
        if (corners.empty() || corners.back() != q) corners.push_back(q);
    }
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    return corners;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Twice the area, positive where the corners turn from +x to +y.
double turn(std::span<const glm::dvec2> corners) {
    double sum = 0.0;
    for (std::size_t i = 2; i < corners.size(); ++i)
        sum += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
    return sum;
}

/// From a to b along its canonical direction.
EdgeInput edgeFrom(const glm::dvec2& a, const glm::dvec2& b) {
    VisibleSegment segment;
    segment.a = gridPoint(a), segment.b = gridPoint(b);
    segment.length = distance(segment.a, segment.b);
    return edgeInput(segment, carrierLine({LineRef::edge(0, 0), a, b}));
}

}  // namespace

void PolygonWeights::add(std::span<const glm::dvec2> polygon, std::vector<PixelShare>& out) {
    const std::vector<glm::dvec2> corners = onGrid(polygon);
    const double area = turn(corners);
    if (area == 0.0) return;
    edges_.clear(), inner_is_left_.clear();
    glm::dvec2 low = corners[0], high = corners[0];
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 &p = corners[i], &q = corners[(i + 1) % corners.size()];
        low = glm::min(low, p), high = glm::max(high, p);
        const bool along = p.y < q.y || (p.y == q.y && p.x > q.x);
        edges_.push_back(along ? edgeFrom(p, q) : edgeFrom(q, p));
        // Left of a canonical edge lies what it turns to with +y to the right of +x.
        inner_is_left_.push_back(along == (area > 0.0));
    }
    const auto first = [&](double from) { return static_cast<int>(std::floor(from - radius_ - 0.5)); };
    const auto last = [&](double to) { return static_cast<int>(std::ceil(to + radius_ - 0.5)); };
    for (int y = first(low.y); y <= last(high.y); ++y) addRow(corners, y, first(low.x), last(high.x), out);
}

void PolygonWeights::addRow(std::span<const glm::dvec2> corners, int y, int x0, int x1,
                            std::vector<PixelShare>& out) {
    Owner base[PixelWeights::kLanes];
    std::size_t offset[PixelWeights::kLanes + 1];
    std::vector<OwnerWeight> owners;
    for (int x = x0; x <= x1; x += PixelWeights::kLanes) {
        const int count = std::min(PixelWeights::kLanes, x1 + 1 - x);
        const glm::dvec2 sample(x + 0.5, y + 0.5);
        weights_.begin(sample, count);
        for (std::size_t i = 0; i < edges_.size(); ++i)
            weights_.add(edges_[i], inner_is_left_[i] ? kInner : kBackground,
                         inner_is_left_[i] ? kBackground : kInner, {0, count - 1});
        for (int k = 0; k < count; ++k)
            base[k] = sdf::holds(corners, sample + glm::dvec2(k + radius_, 0.0)) ? kInner : kBackground;
        owners.clear();
        weights_.finish(base, owners, offset);
        for (int k = 0; k < count; ++k)
            for (std::size_t i = offset[k]; i < offset[k + 1]; ++i)
                if (owners[i].owner == kInner)
                    out.push_back(
                        {x + k, y, std::ldexp(static_cast<double>(owners[i].weight), -kWeightBits)});
    }
}

}  // namespace edgewise
