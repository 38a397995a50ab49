// The lattice of a polygonizer, and where in it the surface is: bricks of cells, each with a tape of its own.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "sdf/prune.h"
#include "sdf/tape.h"

namespace edgewise::sdf {

/// Cells a side of a brick.
inline constexpr int kBrickCells = 8;
/// A brick's tape holds so many cells' widths around it.
inline constexpr double kBrickMargin = 2.0;
/// Cells a side of a lattice.
inline constexpr int kMostResolution = 8192;

/// Cubic cells; a corner's place is the same bits whoever asks.
struct Lattice {
    glm::dvec3 low_world{0.0};
    double step = 1.0;    ///< a cell's side
    glm::ivec3 cells{0};  ///< whole bricks

    double coordinate(int axis, int index) const { return low_world[axis] + step * index; }
    glm::dvec3 corner(const glm::ivec3& i) const {
        return {coordinate(0, i.x), coordinate(1, i.y), coordinate(2, i.z)};
    }
    glm::ivec3 bricks() const { return cells / kBrickCells; }
};

/// `resolution` cells along the box's longest side, rounded up to whole bricks. The lattice is a little
/// larger than the box and off its planes, as what is modelled likes to lie on round numbers.
Lattice latticeOf(const glm::dvec3& low_world, const glm::dvec3& high_world, int resolution);

struct Brick {
    glm::ivec3 first{0};  ///< its first cell
    TapeView tape;        ///< the whole one's bits in the brick and kBrickMargin cells around it
    std::unique_ptr<Pick[]> picks;
};

struct BrickList {
    std::vector<Brick> bricks;            ///< all that the surface may pass
    std::vector<std::uint32_t> at;        ///< by place in Lattice::bricks(), x fastest; kNoBrick: none
    std::uint64_t nodes = 0, pruned = 0;  ///< of the octree: visited, and of those left out
    bool open = false;  ///< a part that was left out is inside and reaches the lattice's end
};
inline constexpr std::uint32_t kNoBrick = 0xffffffffu;

/// By an octree over the lattice: a node goes where its centre's value is more than the Lipschitz bound lets
/// it change on the way to its corners; without `bound_holds`, where its interval is of one sign.
BrickList findBricks(const Tape& tape, const Lattice& lattice, bool bound_holds);

}  // namespace edgewise::sdf
