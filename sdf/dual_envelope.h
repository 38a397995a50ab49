// Where triangles of a dual polygon surely meet no others: Ju and Udeshi 2006's envelope.
#pragma once

#include <span>

#include "sdf/dual_cells.h"

namespace edgewise::sdf {

/// `positions`: of the complex's vertices. Whether side k's line passes the face between its cells: their
/// first condition.
bool throughFace(const Lattice& lattice, std::span<const glm::dvec3> positions, const DualPolygon& polygon,
                 int k);

/// Whether both triangles stay within the polygon's envelope, the tetrahedra of its edge and its sides: for
/// the diagonal from vertex `d`. The edge passes one of them, and the diagonal the triangle of the edge and
/// the fourth vertex.
bool aroundEdge(const Lattice& lattice, std::span<const glm::dvec3> positions, const DualPolygon& polygon,
                int d);

}  // namespace edgewise::sdf
