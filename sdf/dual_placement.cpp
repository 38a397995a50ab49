#include "sdf/dual_placement.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "sdf/held_in_cell.h"
#include "sdf/mesh_feature.h"

namespace edgewise::sdf {
namespace {

/// Of a cell's side: a vertex is kept so far from its cell's faces when it is moved there.
constexpr double kInside = 0.02;
/// Of a cell's side: vertices of different cells nearer than that would be the same.
constexpr double kApart = 0.05;

}  // namespace

bool DualPlacement::inOwnCell(const DualVertex& v, const glm::dvec3& p) const {
    const glm::dvec3 low = lattice_.corner(v.cell.low), high = lattice_.corner(v.cell.low + v.cell.side);
    for (int axis = 0; axis < 3; ++axis)
        if (!(p[axis] >= low[axis] && p[axis] <= high[axis])) return false;
    return true;
}

glm::dvec3 DualPlacement::heldInCell(const DualVertex& v, const glm::dvec3& target) const {
    const glm::dvec3 low = lattice_.corner(v.cell.low), high = lattice_.corner(v.cell.low + v.cell.side);
    return sdf::heldInCell(low, high, kInside * sideOf(v.cell), v.middle_world, target);
}

glm::dvec3 DualPlacement::heldOnSurface(const DualVertex& v) const {
    const glm::dvec3 held = heldInCell(v, v.target_world), moved = onSurface(tape_, held);
    return inOwnCell(v, moved) ? moved : heldInCell(v, moved);
}

bool DualPlacement::freeBeside(const DualVertex& v, glm::ivec3& at) const {
    at = glm::ivec3(glm::floor((v.target_world - lattice_.low_world) / lattice_.step * double(kUnits)));
    const BrickList::Leaf leaf = complex_.bricks.leafAt(lattice_, at);
    at = at / v.cell.side * v.cell.side;
    const glm::ivec3 off = glm::abs(at - v.cell.low) / v.cell.side;
    if (v.mixed || kUnits >> leaf.level != v.cell.side || std::max({off.x, off.y, off.z}) > 1) return false;
    if (leaf.brick == kNoBrick) return true;
    const glm::ivec3 place = (at - complex_.bricks.bricks[leaf.brick].first) / v.cell.side;
    return !complex_.passed[leaf.brick][static_cast<std::size_t>(
        place.x + kBrickCells * (place.y + kBrickCells * place.z))];
}

std::vector<glm::dvec3> placeVertices(const Lattice& lattice, const TapeAt& tape, DualComplex& complex) {
    const DualPlacement placement(lattice, tape, complex);
    std::vector<glm::dvec3> places;
    std::map<std::tuple<int, int, int>, std::vector<glm::dvec3>> taken;
    for (std::size_t n = 0; n < complex.vertices.size(); ++n) {
        DualVertex& v = complex.vertices[n];
        if (!placement.inOwnCell(v, v.target_world)) {
            glm::ivec3 at;
            bool may = placement.freeBeside(v, at);
            auto& others = taken[{at.x, at.y, at.z}];
            for (const glm::dvec3& other : others)
                may &= glm::distance(other, v.target_world) > kApart * lattice.step * v.cell.side / kUnits;
            if (may)
                others.push_back(v.target_world);
            else
                v.target_world = placement.heldOnSurface(v);
        }
        places.push_back(v.target_world);
    }
    return places;
}

}  // namespace edgewise::sdf
