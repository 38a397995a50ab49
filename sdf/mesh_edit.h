// A closed mesh that is changed in a few triangles at a time, and never so that they meet others.
#pragma once

#include <span>
#include <vector>

#include "sdf/surface_mesh.h"

namespace edgewise::sdf {

/// Two triangles' common edge a-b, and their other corners.
struct Diamond {
    std::uint32_t a, b;
    std::array<std::uint32_t, 2> sides, tips;
};

inline bool holds(const Triangle& t, std::uint32_t v) {
    return t[0] == v || t[1] == v || t[2] == v;
}
/// In the triangle's order.
inline std::array<std::uint32_t, 2> othersOf(const Triangle& t, std::uint32_t v) {
    return t[0] == v ? std::array{t[1], t[2]} : t[1] == v ? std::array{t[2], t[0]} : std::array{t[0], t[1]};
}

class MeshEdit {
  public:
    /// `size`: about a triangle's. Materials and normals are dropped.
    MeshEdit(SurfaceMesh& mesh, double size);

    const SurfaceMesh& mesh() const { return mesh_; }
    const glm::dvec3& at(std::uint32_t v) const { return mesh_.position_world[v]; }
    std::span<const std::uint32_t> around(std::uint32_t v) const { return around_[v]; }
    bool isGone(std::uint32_t triangle) const { return mesh_.triangles[triangle][0] == kGone; }
    bool isEdge(std::uint32_t a, std::uint32_t b) const;
    /// False: the edge has not two triangles with tips of their own.
    bool diamondOf(std::uint32_t a, std::uint32_t b, Diamond& d) const;
    /// Vertices around one, each once.
    void neighboursOf(std::uint32_t v, std::vector<std::uint32_t>& out) const;

    // False: nothing has changed, as triangles would have met, or have been something else than a closed
    // surface.
    bool move(std::uint32_t v, const glm::dvec3& to);
    /// A new vertex on the edge; the last of position_world then.
    bool divide(const Diamond& d, const glm::dvec3& place);
    /// The edge between the tips in the place of a-b.
    bool turn(const Diamond& d);
    /// v goes into its neighbour u.
    bool collapse(std::uint32_t v, std::uint32_t u);

    /// Numbers what is left anew.
    void compact();

  private:
    static constexpr std::uint32_t kGone = 0xffffffffu;

    /// `next` in the place of `gone`: as many as there are, then new ones.
    bool replace(std::span<const std::uint32_t> gone, std::span<const Triangle> next);
    bool meets(const Triangle& t) const;
    template <class F>
    void forCells(const Triangle& t, const F& f) const;
    void take(std::uint32_t t);
    void put(std::uint32_t t);

    SurfaceMesh& mesh_;
    const double scale_;
    std::vector<std::vector<std::uint32_t>> around_, cells_;  ///< cells: of a grid, by hash
    std::vector<std::uint32_t> gone_;
    std::vector<Triangle> next_;
};

}  // namespace edgewise::sdf
