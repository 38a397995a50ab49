// Which triangles of a mesh are near?
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sdf/surface_mesh.h"

namespace edgewise::sdf {

/// Squared distance from a point to a triangle.
double squaredDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Boxes in boxes around triangles, which it refers to.
class TriangleTree {
  public:
    TriangleTree(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles);
    /// Of some of the triangles.
    TriangleTree(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles,
                 std::vector<std::uint32_t> some);
    /// Whether a triangle is at most so far from the point.
    bool near(const glm::dvec3& p, double distance) const;
    /// f(triangle) for all whose leaves' boxes meet the box, and maybe some more.
    template <class F>
    void forNear(const glm::dvec3& low, const glm::dvec3& high, const F& f) const {
        const auto meets = [&](const Node& node) {
            return node.low.x <= high.x && node.low.y <= high.y && node.low.z <= high.z &&
                   low.x <= node.high.x && low.y <= node.high.y && low.z <= node.high.z;
        };
        anyIn(meets, [&](std::uint32_t t) {
            f(t);
            return false;
        });
    }

  private:
    static constexpr int kDeepest = 64;
    struct Node {
        glm::dvec3 low, high;
        std::uint32_t begin, count;  ///< of `order_`; count 0: children are the next node and node `begin`
    };
    /// Whether found(triangle) for one in the nodes that are entered; then no more are asked.
    template <class Enters, class Found>
    bool anyIn(const Enters& enters, const Found& found) const {
        std::uint32_t waiting[kDeepest];
        int count = 0;
        if (!nodes_.empty()) waiting[count++] = 0;
        while (count > 0) {
            const std::uint32_t at = waiting[--count];
            const Node& node = nodes_[at];
            if (!enters(node)) continue;
            if (node.count == 0) waiting[count++] = at + 1, waiting[count++] = node.begin;
            for (std::uint32_t n = 0; n < node.count; ++n)
                if (found(order_[node.begin + n])) return true;
        }
        return false;
    }
    void build();
    void build(std::uint32_t begin, std::uint32_t end);

    std::span<const glm::dvec3> positions_;
    std::span<const Triangle> triangles_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace edgewise::sdf
