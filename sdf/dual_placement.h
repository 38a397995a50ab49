// Where dual contouring's vertices are, at first and when they are moved for the mesh not to meet itself.
#pragma once

#include "sdf/dual_cells.h"

namespace edgewise::sdf {

class DualPlacement {
  public:
    DualPlacement(const Lattice& lattice, const TapeAt& tape, const DualComplex& complex)
        : lattice_(lattice), tape_(tape), complex_(complex) {}

    bool inOwnCell(const DualVertex& v, const glm::dvec3& p) const;

    /// On the way from the loop's middle to the target, the last place well within the cell.
    glm::dvec3 heldInCell(const DualVertex& v, const glm::dvec3& target) const;

    /// On the surface, or well within the cell.
    glm::dvec3 heldOnSurface(const DualVertex& v) const;

    /// Whether a vertex belongs into a cell of its own one's size beside it that the surface does not pass;
    /// `at`: which one.
    bool freeBeside(const DualVertex& v, glm::ivec3& at) const;

  private:
    double sideOf(const DualCell& cell) const { return lattice_.step * cell.side / kUnits; }

    const Lattice& lattice_;
    const TapeAt& tape_;
    const DualComplex& complex_;
};

/// Of a complex's vertices. One may be in the cell next to its own where the surface has none of its own: a
/// sharp edge that just looks in. Two in one place would be one. Others keep to their cells, their targets
/// too.
std::vector<glm::dvec3> placeVertices(const Lattice& lattice, const TapeAt& tape, DualComplex& complex);

}  // namespace edgewise::sdf
