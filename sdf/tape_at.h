// Short tapes anywhere in a lattice.
#pragma once

#include <algorithm>

#include "sdf/cell_tapes.h"
#include "sdf/mesh_lattice.h"

namespace edgewise::sdf {

/// By place the whole tape, or a shorter one with its bits there: made where that pays, for all threads.
/// Refers to the tape.
class TapeAt {
  public:
    TapeAt(const Tape& whole, const Lattice& lattice, bool bound_holds)
        : cells_(whole, lattice.corner(lattice.units() / 2),
                 0.5 * lattice.step * std::max({lattice.cells.x, lattice.cells.y, lattice.cells.z}) +
                     lattice.step,
                 bound_holds) {}

    /// For that point alone.
    TapeView operator()(const glm::dvec3& p_world) const {
        const TapeCell& cell = cells_.at(p_world);
        cells_.ran(cell, 1);
        return cell.tape;
    }

  private:
    const CellTapes cells_;
};

}  // namespace edgewise::sdf
