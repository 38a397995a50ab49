// Is a point near a mesh?
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
    /// Whether a triangle is at most so far from the point.
    bool near(const glm::dvec3& p, double distance) const;

  private:
    struct Node {
        glm::dvec3 low, high;
        std::uint32_t begin, count;  ///< of `order_`; count 0: children are the next node and node `begin`
    };
    void build(std::uint32_t begin, std::uint32_t end);

    std::span<const glm::dvec3> positions_;
    std::span<const Triangle> triangles_;
    std::vector<std::uint32_t> order_;
    std::vector<glm::dvec3> centre_;
    std::vector<Node> nodes_;
};

}  // namespace edgewise::sdf
