// What dual contouring knows after looking at every brick: cells with their loops' vertices, and a polygon
// for each edge that the surface crosses.
#pragma once

#include <array>
#include <vector>

#include "sdf/mesh_cell.h"
#include "sdf/mesh_crossings.h"
#include "sdf/mesh_lattice.h"
#include "sdf/mesh_qef.h"
#include "sdf/polygonize.h"

namespace edgewise::sdf {

inline constexpr std::uint32_t kNoVertex = 0xffffffffu;

/// A loop's vertex.
struct DualVertex {
    glm::dvec3 target_world;  ///< where it belongs: mesh_feature
    glm::dvec3 middle_world;  ///< of the loop's crossings
    glm::ivec3 cell{0};
    std::uint32_t brick = 0;
    std::uint8_t rank = 1;   ///< mesh_feature's
    std::uint8_t loops = 1;  ///< of its cell
};

struct DualCell {
    std::uint32_t first_vertex = 0;
    CellLoops loops;
    std::uint32_t vertexOf(int edge) const {
        return first_vertex + static_cast<std::uint32_t>(loops.loop[edge]);
    }
};

/// Around a crossed edge: the four cells counter-clockwise about its axis, from the one below along the next
/// two axes.
struct DualPolygon {
    glm::ivec3 corner{0};  ///< the edge's lower end
    std::uint8_t axis = 0;
    bool outward = true;  ///< the outside is at the edge's upper end
    std::uint32_t brick = 0;
    std::array<std::uint32_t, 4> vertex{};
    std::array<std::uint32_t, 4> across{};  ///< the polygon that shares side k, from vertex k to the next one
    TangentPlane crossing{};                ///< of the surface with the edge
};

struct DualComplex {
    BrickList bricks;
    std::vector<DualVertex> vertices;
    std::vector<DualPolygon> polygons;
    std::uint64_t cells = 0;
    std::vector<DualCell> cell;         ///< those that the surface passes
    std::vector<std::int32_t> cell_at;  ///< by brick and place in it; -1: none
    /// nullptr: the surface does not pass it.
    const DualCell* find(const Lattice& lattice, const glm::ivec3& cell) const;
};

/// Throws SceneError where the surface reaches the lattice's end.
DualComplex dualComplex(const MeshRequest& request);

/// Side k's other cell and the number of the polygon's edge in cell k.
inline glm::ivec3 polygonCell(const DualPolygon& polygon, int k) {
    constexpr int kU[4] = {-1, 0, 0, -1}, kV[4] = {-1, -1, 0, 0};
    glm::ivec3 cell = polygon.corner;
    cell[(polygon.axis + 1) % 3] += kU[k], cell[(polygon.axis + 2) % 3] += kV[k];
    return cell;
}
inline int polygonEdge(const DualPolygon& polygon, int k) {
    constexpr int kPlace[4] = {3, 2, 0, 1};
    return 4 * polygon.axis + kPlace[k];
}
/// Of cell k, the face towards cell k + 1.
inline int polygonFace(const DualPolygon& polygon, int k) {
    const int u = (polygon.axis + 1) % 3, v = (polygon.axis + 2) % 3;
    const int faces[4] = {2 * u + 1, 2 * v + 1, 2 * u, 2 * v};
    return faces[k];
}

}  // namespace edgewise::sdf
