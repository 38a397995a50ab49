// Where the surface crosses the edges of a brick's cells.
#pragma once

#include <bitset>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "sdf/mesh_cell.h"
#include "sdf/tape_at.h"

namespace edgewise::sdf {

struct Crossing {
    glm::dvec3 place_world;
    glm::dvec3 normal_world;  ///< unit, outward: the gradient's direction there
    bool made = false;        ///< of a corner that was turned: the surface is not there
};

/// One brick's values at its corners and crossings of its edges; those on its upper faces are the neighbours'
/// too, with the same bits.
class BrickCrossings {
  public:
    static constexpr int kSide = kBrickCells + 1, kCorners = kSide * kSide * kSide;

    /// Reads the brick anew.
    void read(const Lattice& lattice, const Brick& brick, const TapeAt& tape) {
        readValues(lattice, brick);
        findCrossings(lattice, brick, tape);
    }
    /// Its values alone.
    void readValues(const Lattice& lattice, const Brick& brick);
    /// Values that somebody else knows, by indexOf(), without crossings; then those one by one.
    void set(std::span<const double> values);
    void add(const glm::ivec3& corner, int axis, const Crossing& crossing);
    /// From then on a corner counts as on the surface's other side; edges cross it in their middle there.
    void turn(const glm::ivec3& c);
    void findCrossings(const Lattice& lattice, const Brick& brick, const TapeAt& tape);

    /// By a corner's place in the brick.
    double value(const glm::ivec3& c) const { return values_[indexOf(c)]; }
    /// Of the edge along the axis from the corner on; nullptr: the surface does not cross it.
    const Crossing* crossing(const glm::ivec3& corner, int axis) const {
        const int at = at_[axis][indexOf(corner)];
        return at < 0 ? nullptr : &crossings_[static_cast<std::size_t>(at)];
    }
    /// Of a cell's edge, by mesh_cell's numbers.
    const Crossing& crossing(const glm::ivec3& cell, const EdgeEnds& edge) const {
        return *crossing(cell + cornerOffset(edge.low), edge.axis);
    }
    void cellValues(const glm::ivec3& cell, double (&values)[kCellCorners]) const {
        for (int c = 0; c < kCellCorners; ++c) values[c] = value(cell + cornerOffset(c));
    }
    /// Whether a corner at the lattice's end is inside.
    bool open(const Lattice& lattice, const Brick& brick) const;
    /// Whether the signs at a cell's corners differ.
    bool crosses(const glm::ivec3& cell) const;

    static glm::ivec3 cornerOffset(int corner) { return {corner & 1, corner >> 1 & 1, corner >> 2}; }
    static int indexOf(const glm::ivec3& c) { return c.x + kSide * (c.y + kSide * c.z); }

  private:
    void addCrossing(const TapeAt& tape, const glm::ivec3& corner, int axis, const glm::dvec3& p, bool made);

    std::array<double, kCorners> values_;
    std::array<std::array<int, kCorners>, 3> at_;
    std::bitset<kCorners> turned_;
    std::vector<Crossing> crossings_;
};

}  // namespace edgewise::sdf
