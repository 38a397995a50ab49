// Where a mesher gets bricks' values and crossings from.
#pragma once

#include "sdf/mesh_crossings.h"

namespace edgewise::sdf {

class BrickSource {
  public:
    virtual ~BrickSource() = default;
    /// A brick's values at its corners, by its place in the list.
    virtual void readValues(std::size_t brick, BrickCrossings& into) const = 0;
    /// Those, and the crossings of all edges.
    virtual void read(std::size_t brick, BrickCrossings& into) const = 0;
};

/// A tape's.
class TapeBricks : public BrickSource {
  public:
    TapeBricks(const Lattice& lattice, const BrickList& list, const TapeAt& tape)
        : lattice_(lattice), list_(list), tape_(tape) {}
    void readValues(std::size_t brick, BrickCrossings& into) const override {
        into.readValues(lattice_, list_.bricks[brick]);
    }
    void read(std::size_t brick, BrickCrossings& into) const override {
        into.read(lattice_, list_.bricks[brick], tape_);
    }

  private:
    const Lattice& lattice_;
    const BrickList& list_;
    const TapeAt& tape_;
};

}  // namespace edgewise::sdf
