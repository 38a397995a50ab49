// How far a mesh may be off its surface.
#pragma once

#include <bitset>
#include <vector>

#include "sdf/mesh_lattice.h"
#include "sdf/most_off.h"

namespace edgewise::sdf {

/// Lengths in the world, or parts of what is asked for.
struct MeshLimits {
    double sharp;   ///< by sharp edges
    double smooth;  ///< elsewhere
    const MostOff* most_off = nullptr;

    /// As lengths: the least within a ball.
    MeshLimits within(const glm::dvec3& centre_world, double radius) const {
        if (!most_off) return *this;
        const double most = most_off->leastWithin(centre_world, radius);
        return {sharp * most, smooth * most};
    }
};

/// Where sharp edges are: cells.
class SharpCells {
  public:
    SharpCells(const Lattice& lattice, const BrickList& bricks)
        : lattice_(lattice),
          bricks_(bricks),
          sharp_(bricks.bricks.size()),
          any_(bricks.bricks.size(), false) {}

    /// Those within two cells of one that a sharp edge passes: its lower corner and its side in units.
    void addAround(const glm::ivec3& low, int side) {
        for (int n = 0; n < 125; ++n)
            add(low + side / 2 + side * glm::ivec3(n % 5 - 2, n / 5 % 5 - 2, n / 25 - 2));
    }
    /// Also where no brick is.
    bool at(const glm::dvec3& p_world) const {
        const glm::ivec3 unit = lattice_.unitAt(p_world);
        const std::uint32_t brick = bricks_.leafAt(lattice_, unit).brick;
        return brick == kNoBrick || (any_[brick] && sharp_[brick].test(placeOf(brick, unit)));
    }
    /// How many there are, and the one at a place, or kNoBrick.
    std::uint32_t bricks() const { return static_cast<std::uint32_t>(sharp_.size()); }
    std::uint32_t brickAt(const glm::dvec3& p_world) const {
        return bricks_.leafAt(lattice_, lattice_.unitAt(p_world)).brick;
    }
    /// Of the cells around a place.
    double sideAt(const glm::dvec3& p_world) const {
        return lattice_.step / (1 << bricks_.leafAt(lattice_, lattice_.unitAt(p_world)).level);
    }
    bool cell(std::uint32_t brick, std::size_t place) const { return sharp_[brick].test(place); }

  private:
    std::size_t placeOf(std::uint32_t brick, const glm::ivec3& unit) const {
        const glm::ivec3 place = (unit - bricks_.bricks[brick].first) / bricks_.bricks[brick].cellUnits();
        return static_cast<std::size_t>(place.x + kBrickCells * (place.y + kBrickCells * place.z));
    }
    void add(const glm::ivec3& unit) {
        if (!last_.holds(unit)) {
            const BrickList::Leaf leaf = bricks_.leafAt(lattice_, unit);
            if (leaf.brick == kNoBrick) return;
            const Brick& brick = bricks_.bricks[leaf.brick];
            last_ = {leaf.brick, brick.first, brick.first + kBrickCells * brick.cellUnits()};
            any_[leaf.brick] = true;
        }
        sharp_[last_.brick].set(placeOf(last_.brick, unit));
    }

    struct Range {
        std::uint32_t brick = kNoBrick;
        glm::ivec3 low{0}, high{0};
        bool holds(const glm::ivec3& u) const {
            return u.x >= low.x && u.y >= low.y && u.z >= low.z && u.x < high.x && u.y < high.y &&
                   u.z < high.z;
        }
    };

    const Lattice& lattice_;
    const BrickList& bricks_;
    std::vector<std::bitset<kBrickCells * kBrickCells * kBrickCells>> sharp_;
    std::vector<bool> any_;  ///< by brick
    Range last_;
};

}  // namespace edgewise::sdf
