#include "sdf/triangle_tree.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

namespace edgewise::sdf {
namespace {

constexpr std::uint32_t kLeaf = 8;

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

void TriangleTree::build() {
    keys_.resize(order_.size());
    for (std::size_t n = 0; n < order_.size(); ++n) {
        const Triangle& t = triangles_[order_[n]];
        keys_[n] = {positions_[t[0]] + positions_[t[1]] + positions_[t[2]], order_[n]};
    }
    if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
    for (std::size_t n = 0; n < order_.size(); ++n) order_[n] = keys_[n].triangle;
    keys_ = {};
}

void TriangleTree::build(std::uint32_t begin, std::uint32_t end) {
    const std::size_t own = nodes_.size();
    Node node{glm::dvec3(1e300), glm::dvec3(-1e300), begin, end - begin};
    for (std::uint32_t n = begin; n < end; ++n)
        for (const std::uint32_t v : triangles_[keys_[n].triangle])
            node.low = glm::min(node.low, positions_[v]), node.high = glm::max(node.high, positions_[v]);
    nodes_.push_back(node);
    if (end - begin <= kLeaf) return;
    const glm::dvec3 size = node.high - node.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(keys_.begin() + begin, keys_.begin() + middle, keys_.begin() + end,
                     [&](const Key& a, const Key& b) { return a.centre[axis] < b.centre[axis]; });
    build(begin, middle);
    nodes_[own].begin = static_cast<std::uint32_t>(nodes_.size()), nodes_[own].count = 0;
    build(middle, end);
}

bool TriangleTree::near(const glm::dvec3& p, double distance) const {
    const double most = distance * distance;
    std::uint32_t waiting[kDeepest];
    int count = 0;
    if (!nodes_.empty()) waiting[count++] = 0;
    while (count > 0) {
        const std::uint32_t at = waiting[--count];
        const Node& node = nodes_[at];
        if (squaredToBox(p, node.low, node.high) > most) continue;
        if (node.count == 0) {
            waiting[count++] = at + 1, waiting[count++] = node.begin;
            continue;
        }
        for (std::uint32_t n = node.begin; n < node.begin + node.count; ++n) {
            const Triangle& t = triangles_[order_[n]];
            if (squaredDistance(p, positions_[t[0]], positions_[t[1]], positions_[t[2]]) <= most) return true;
        }
    }
    return false;
}

}  // namespace edgewise::sdf
