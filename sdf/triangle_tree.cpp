#include "sdf/triangle_tree.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

namespace edgewise::sdf {
namespace {

constexpr std::uint32_t kLeaf = 8;
/// Along a side of the box around all.
constexpr double kCurveCells = 1023.999;

/// Of ten bits each, the bits by turns.
std::uint32_t curvePlace(const glm::uvec3& p) {
    const auto spread = [](std::uint32_t x) {
        x = (x | x << 16) & 0x030000ffu;
        x = (x | x << 8) & 0x0300f00fu;
        x = (x | x << 4) & 0x030c30c3u;
        return (x | x << 2) & 0x09249249u;
    };
    return spread(p.x) | spread(p.y) << 1 | spread(p.z) << 2;
}

double squaredToSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 way = b - a, from = p - a;
    const double length2 = glm::dot(way, way);
    const double part = length2 > 0.0 ? std::clamp(glm::dot(from, way) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec3 off = from - part * way;
    return glm::dot(off, off);
}

double squaredToBox(const glm::dvec3& p, const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 off = glm::max(glm::max(low - p, p - high), glm::dvec3(0.0));
    return glm::dot(off, off);
}

}  // namespace

double squaredDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double size2 = glm::dot(normal, normal);
    // Above the triangle: on the inner side of all three.
    const bool above = size2 > 0.0 && glm::dot(glm::cross(b - a, p - a), normal) >= 0.0 &&
                       glm::dot(glm::cross(c - b, p - b), normal) >= 0.0 &&
                       glm::dot(glm::cross(a - c, p - c), normal) >= 0.0;
    if (above) {
        const double height = glm::dot(p - a, normal);
        return height * height / size2;
    }
    return std::min({squaredToSegment(p, a, b), squaredToSegment(p, b, c), squaredToSegment(p, c, a)});
}

TriangleTree::TriangleTree(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles)
    : positions_(positions), triangles_(triangles), order_(triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    build();
}

TriangleTree::TriangleTree(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles,
                           std::vector<std::uint32_t> some)
    : positions_(positions), triangles_(triangles), order_(std::move(some)) {
    build();
}

/// In the order of their centres along a Morton curve, halved again and again.
void TriangleTree::build() {
    glm::dvec3 low(1e300), high(-1e300);
    for (const std::uint32_t t : order_)
        for (const std::uint32_t v : triangles_[t])
            low = glm::min(low, positions_[v]), high = glm::max(high, positions_[v]);
    const glm::dvec3 scale = kCurveCells / glm::max(high - low, glm::dvec3(1e-300));
    std::vector<std::uint64_t> keys(order_.size());
    for (std::size_t n = 0; n < order_.size(); ++n) {
        const Triangle& t = triangles_[order_[n]];
        const glm::dvec3 centre = (positions_[t[0]] + positions_[t[1]] + positions_[t[2]]) / 3.0;
        keys[n] = std::uint64_t(curvePlace(glm::uvec3((centre - low) * scale))) << 32 | order_[n];
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t n = 0; n < order_.size(); ++n) order_[n] = static_cast<std::uint32_t>(keys[n]);
    nodes_.reserve(order_.size() / (kLeaf / 4) + 1);
    if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

void TriangleTree::build(std::uint32_t begin, std::uint32_t end) {
    const std::size_t own = nodes_.size();
    Node node{glm::dvec3(1e300), glm::dvec3(-1e300), begin, end - begin};
    nodes_.push_back(node);
    if (end - begin <= kLeaf) {
        for (std::uint32_t n = begin; n < end; ++n)
            for (const std::uint32_t v : triangles_[order_[n]])
                node.low = glm::min(node.low, positions_[v]), node.high = glm::max(node.high, positions_[v]);
    } else {
        const std::uint32_t middle = begin + (end - begin) / 2;
        build(begin, middle);
        const auto second = static_cast<std::uint32_t>(nodes_.size());
        build(middle, end);
        node.low = glm::min(nodes_[own + 1].low, nodes_[second].low);
        node.high = glm::max(nodes_[own + 1].high, nodes_[second].high);
        node.begin = second, node.count = 0;
    }
    nodes_[own] = node;
}

bool TriangleTree::near(const glm::dvec3& p, double distance) const {
    const double most = distance * distance;
    return anyIn([&](const Node& node) { return squaredToBox(p, node.low, node.high) <= most; },
                 [&](std::uint32_t at) {
                     const auto& [a, b, c] = triangles_[at];
                     return squaredDistance(p, positions_[a], positions_[b], positions_[c]) <= most;
                 });
}

}  // namespace edgewise::sdf
