// What dual contouring knows after looking at every brick: a vertex for each part of the surface in a cell,
// and a polygon for each edge that the surface crosses.
#pragma once

#include <array>
#include <bitset>
#include <vector>

#include "sdf/mesh_cell.h"
#include "sdf/mesh_crossings.h"
#include "sdf/mesh_lattice.h"
#include "sdf/mesh_qef.h"
#include "sdf/polygonize.h"
#include "sdf/tape_at.h"

namespace edgewise::sdf {

inline constexpr std::uint32_t kNoVertex = 0xffffffffu;

/// A cube of a lattice's leaf, in units.
struct DualCell {
    glm::ivec3 low{0};
    int side = kUnits;
    bool operator==(const DualCell&) const = default;
};

/// A loop's vertex.
struct DualVertex {
    glm::dvec3 target_world;  ///< where it belongs: mesh_feature
    glm::dvec3 middle_world;  ///< of the loop's crossings
    DualCell cell;
    std::uint32_t brick = 0;
    std::uint8_t rank = 1;   ///< mesh_feature's
    std::uint8_t loops = 1;  ///< of its cell
    bool mixed = false;      ///< smaller cells are beside its own
};

/// Around a crossed edge that no smaller one is part of: the four cells counter-clockwise about its axis,
/// from the one below along the next two axes. A larger cell that has two of the places is there twice: the
/// polygon is a triangle.
struct DualPolygon {
    glm::ivec3 corner{0};  ///< the edge's lower end, in units
    std::uint8_t axis = 0;
    std::uint8_t level = 0;
    bool outward = true;  ///< the outside is at the edge's upper end
    bool mixed = false;   ///< not all cells are of its own size and by themselves
    std::uint32_t brick = 0;
    std::array<std::uint32_t, 4> vertex{kNoVertex, kNoVertex, kNoVertex, kNoVertex};
    /// The polygon that shares side k, from vertex k to the next one, and which of its sides that is.
    std::array<std::uint32_t, 4> across{kNoVertex, kNoVertex, kNoVertex, kNoVertex};
    std::array<std::uint8_t, 4> across_side{};
    TangentPlane crossing{};  ///< of the surface with the edge
    bool made = false;        ///< the crossing is not on the surface: dual_wedges

    bool isSide(int k) const { return vertex[k] != vertex[(k + 1) % 4]; }
};

struct DualComplex {
    BrickList bricks;
    std::vector<DualVertex> vertices;
    std::vector<DualPolygon> polygons;
    std::uint64_t cells = 0;
    std::uint64_t turned = 0;  ///< corners of bricks: dual_wedges
    std::vector<std::bitset<kBrickCells * kBrickCells * kBrickCells>> passed;  ///< cells, by brick
};

/// Of bricks that the surface may pass, some of them divided. Throws SceneError where it reaches the
/// lattice's end.
DualComplex dualComplex(const MeshRequest& request, const TapeAt& tape, BrickList bricks);
inline DualComplex dualComplex(const MeshRequest& request) {
    return dualComplex(request, TapeAt(request.tape, request.lattice, request.bound_holds),
                       findBricks(request.tape, request.lattice, request.bound_holds));
}

/// Cell k of a polygon that is not mixed.
inline glm::ivec3 polygonCell(const DualPolygon& polygon, int k) {
    constexpr int kU[4] = {-1, 0, 0, -1}, kV[4] = {-1, -1, 0, 0};
    const int side = kUnits >> polygon.level;
    glm::ivec3 cell = polygon.corner;
    cell[(polygon.axis + 1) % 3] += kU[k] * side, cell[(polygon.axis + 2) % 3] += kV[k] * side;
    return cell;
}
/// Of cell k, the axis across its face towards cell k + 1.
inline int sideAxis(const DualPolygon& polygon, int k) {
    return (polygon.axis + 1 + (k & 1)) % 3;
}

}  // namespace edgewise::sdf
