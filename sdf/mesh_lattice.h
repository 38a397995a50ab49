// The lattice of a polygonizer, and where in it the surface is: bricks of cells, each with a tape of its own.
#pragma once

#include <array>
#include <cstdint>
#include <glm/common.hpp>
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

/// A brick may be divided so often; a unit is the side of the cells of the last ones.
inline constexpr int kMostLevels = 8, kUnits = 1 << kMostLevels;

/// Cubic cells; a corner's place is the same bits whoever asks.
struct Lattice {
    glm::dvec3 low_world{0.0};
    double step = 1.0;    ///< a cell's side
    glm::ivec3 cells{0};  ///< whole bricks

    /// By a place in units, of which a cell has kUnits.
    double coordinate(int axis, int unit) const { return low_world[axis] + step * (unit * (1.0 / kUnits)); }
    glm::dvec3 corner(const glm::ivec3& u) const {
        return {coordinate(0, u.x), coordinate(1, u.y), coordinate(2, u.z)};
    }
    /// The cube of one unit that holds a point; off the lattice where the point is.
    glm::ivec3 unitAt(const glm::dvec3& p_world) const {
        const glm::dvec3 place = (p_world - low_world) / step * static_cast<double>(kUnits);
        return glm::ivec3(glm::floor(glm::clamp(place, -1.0, 1e9)));
    }
    glm::ivec3 bricks() const { return cells / kBrickCells; }
    glm::ivec3 units() const { return cells * kUnits; }
};

/// `resolution` cells along the box's longest side, rounded up to whole bricks. The lattice is a little
/// larger than the box and off its planes, as what is modelled likes to lie on round numbers.
Lattice latticeOf(const glm::dvec3& low_world, const glm::dvec3& high_world, int resolution);

/// A cube of cells, whose sides are halves of the lattice's, `level` times.
struct Brick {
    glm::ivec3 first{0};  ///< its first cell, in units
    int level = 0;
    bool divided = false;  ///< others are in its place
    TapeView tape;  ///< the whole one's bits in the brick and kBrickMargin of the lattice's cells around it
    std::unique_ptr<Pick[]> picks;

    int cellUnits() const { return kUnits >> level; }
    glm::ivec3 unitsOf(const glm::ivec3& corner) const { return first + cellUnits() * corner; }
};

inline constexpr std::uint32_t kNoBrick = 0xffffffffu, kDividedBit = 0x80000000u;

struct BrickList {
    std::vector<Brick> bricks;      ///< all that the surface may pass
    std::vector<std::uint32_t> at;  ///< by place in Lattice::bricks(), x fastest: as those of `parts`
    /// Of divided bricks, x fastest: a brick, kNoBrick, or kDividedBit and an index into `parts`.
    std::vector<std::array<std::uint32_t, 8>> parts;
    std::uint64_t nodes = 0, pruned = 0;  ///< of the octree: visited, and of those left out
    bool open = false;  ///< a part that was left out is inside and reaches the lattice's end

    struct Leaf {
        std::uint32_t brick;  ///< kNoBrick: no surface there
        int level;            ///< also of what was left out
    };
    /// Which one holds the cube of one unit that begins there.
    Leaf leafAt(const Lattice& lattice, const glm::ivec3& unit) const;
};

/// By an octree over the lattice: a node goes where its centre's value is more than the Lipschitz bound lets
/// it change on the way to its corners; without `bound_holds`, where its interval is of one sign.
BrickList findBricks(const Tape& tape, const Lattice& lattice, bool bound_holds);

/// Eight bricks of half its side in its place; those that the surface does not pass are left out.
void divideBrick(const Tape& tape, const Lattice& lattice, bool bound_holds, std::uint32_t brick,
                 BrickList& list);

}  // namespace edgewise::sdf
