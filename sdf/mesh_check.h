// Where is a mesh off its surface?
#pragma once

#include "sdf/dual_cells.h"
#include "sdf/mesh_attributes.h"
#include "sdf/mesh_limits.h"
#include "sdf/surface_mesh.h"

namespace edgewise::sdf {

/// A place where mesh and surface are apart, and how many times its cells are to be halved for that to
/// change.
struct PlaceOff {
    glm::dvec3 place_world;
    int level;           ///< of its brick now
    int halved;          ///< 1 to kMostHalved, by how far off it is
    double times_limit;  ///< on a smooth part how far off; elsewhere 1
};
inline constexpr int kMostHalved = 3;

/// Where more than the limits was found: from the mesh's edges' middles and triangles' centres to the
/// surface; from where the surface crosses cells' edges, and from where it is nearest to cells' centres, to
/// the mesh. What the mesh has missed whole is found so too.
std::vector<PlaceOff> placesOff(const SurfaceMesh& mesh, const MeshRequest& request, const TapeAt& tape,
                                const DualComplex& complex, const SharpCells& sharp,
                                const MeshLimits& limits);

/// At least so many bricks it takes until smooth parts are near enough: their error falls with the square of
/// a cell's side, or by four more where edges are divided. Infinite where cells cannot be divided so often.
double bricksNeeded(const std::vector<PlaceOff>& places, const MeshRequest& request, const BrickList& bricks);

/// Divides the bricks of such places, until there are so many. Gives how many; 0: all are as small as they
/// can be.
std::size_t divideAt(const std::vector<PlaceOff>& places, const MeshRequest& request, std::size_t most_bricks,
                     BrickList& bricks);

}  // namespace edgewise::sdf
