// Parts of the surface that sampling has cut off.
#pragma once

#include "sdf/dual_cells.h"

namespace edgewise::sdf {

/// Towards a knife edge a solid is at last thinner than cells are: corners find it here and there, and each
/// find is a closed surface by itself (as bubbles are in a crease of the outside). Such a surface is left out
/// when a way from a corner within it, on which balls of the field's value hold only what is inside, comes to
/// a corner of the lattice that is inside but not within that surface. What is a part by itself, however
/// small, is kept, as nothing leads out of it; and so is what no such way decides. Without the bound nothing
/// goes. Gives how many surfaces went; polygons and vertices are numbered anew.
std::size_t leaveOutDebris(const MeshRequest& request, const TapeAt& tape, DualComplex& complex);

}  // namespace edgewise::sdf
