// Corners of cells in wedges thinner than cells.
#pragma once

#include "sdf/mesh_crossings.h"
#include "sdf/polygonize.h"

namespace edgewise::sdf {

/// Towards its sharp edge a wedge of the solid, or of the outside, becomes thinner than cells are; what
/// corners see of it there are islands and holes. Corners where a wedge is thinner than the finest cell
/// around are turned to its other side: along an axis near the wedge's normals every line that is left passes
/// a corner, so that there are neither. Refinement takes the mesh to the edge afterwards, as far as it
/// reaches; corners from which the wedge gets thick no sooner are left as they are, as are sheets and wires,
/// which do not get thick at all.
class WedgeCorners {
  public:
    WedgeCorners(const MeshRequest& request, const TapeAt& tape, const BrickList& bricks)
        : request_(request), tape_(tape), bricks_(bricks) {}

    /// Turns the brick's, so many; the same ones whichever brick asks.
    std::size_t turnIn(const Brick& brick, BrickCrossings& crossings) const;

    /// By the whole tape: the corner's value, its sign turned where it is.
    double valueAt(const glm::ivec3& unit) const;

  private:
    bool isThin(const glm::ivec3& unit, double value) const;
    double finestAround(const glm::ivec3& unit) const;

    const MeshRequest& request_;
    const TapeAt& tape_;
    const BrickList& bricks_;
};

}  // namespace edgewise::sdf
