// How far places are from a mesh. For the files that have CGAL.
#pragma once

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <vector>

#include "sdf/surface_mesh.h"

namespace edgewise {

/// Of a mesh's triangles: edges' middles, the centre, and halfway from it to the corners, as weights of the
/// corners. Every place of a triangle is within a third of its longest side of one of them.
inline constexpr double kTrianglePlaces[][3] = {
    {0.5, 0.5, 0.0},          {0.0, 0.5, 0.5},          {0.5, 0.0, 0.5},         {1 / 3., 1 / 3., 1 / 3.},
    {4 / 6., 1 / 6., 1 / 6.}, {1 / 6., 4 / 6., 1 / 6.}, {1 / 6., 1 / 6., 4 / 6.}};

class NearestTriangle {
  public:
    explicit NearestTriangle(const sdf::SurfaceMesh& mesh) {
        const auto corner = [&](std::uint32_t v) { return point(mesh.position_world[v]); };
        for (const sdf::Triangle& t : mesh.triangles)
            triangles_.emplace_back(corner(t[0]), corner(t[1]), corner(t[2]));
        tree_.insert(triangles_.begin(), triangles_.end());
        tree_.build();
    }
    NearestTriangle(const NearestTriangle&) = delete;
    NearestTriangle& operator=(const NearestTriangle&) = delete;

    double distance(const glm::dvec3& p_world) const {
        return std::sqrt(tree_.squared_distance(point(p_world)));
    }

  private:
    using Kernel = CGAL::Simple_cartesian<double>;
    using Triangles = std::vector<Kernel::Triangle_3>;
    using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>;
    static Kernel::Point_3 point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

    Triangles triangles_;
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

}  // namespace edgewise
