// Meshes of the surface where a tape's value is 0.
#pragma once

#include <optional>

#include "sdf/brick_source.h"
#include "sdf/mesh_lattice.h"
#include "sdf/most_off.h"
#include "sdf/surface_mesh.h"

namespace edgewise::sdf {

struct MeshRequest {
    const Tape& tape;
    Lattice lattice;
    /// Values change no faster than the tape says (check_lipschitz); false: intervals find the surface.
    bool bound_holds = true;
    bool attributes = true;  ///< normals too
    /// Dual contouring: how far mesh and surface may be apart, as far as cells can be divided for it; none: a
    /// small part of a cell.
    std::optional<MostOff> most_off = {};
    std::size_t most_bricks = std::size_t(1) << 20;  ///< cells are divided no further when there are more
};

struct MeshCounts {
    std::uint64_t nodes = 0, pruned = 0;  ///< of the octree
    std::uint64_t bricks = 0, cells = 0;  ///< that the surface passes
    std::uint64_t mended = 0;             ///< vertices moved, polygons divided: against intersections
    std::uint64_t collapsed = 0;          ///< vertices of flat parts left out
    std::uint64_t turned = 0;             ///< corners in wedges thinner than cells
    std::uint64_t debris = 0;             ///< closed surfaces left out that sampling had cut off
    std::uint64_t added = 0;              ///< vertices where edges were off the surface
    double bricks_needed = 0.0;           ///< at least, where that is more than there may be
};

/// Marching cubes (Lorensen and Cline 1987), loops instead of a table: faces with two ways to go are decided
/// by their values alone, so that the mesh is closed and manifold. Throws SceneError where the surface
/// reaches the lattice's end.
SurfaceMesh marchingCubes(const MeshRequest& request, MeshCounts& counts);

/// The same of what a source tells of a list's bricks; without materials and normals.
SurfaceMesh marchBricks(const Lattice& lattice, const BrickList& bricks, const BrickSource& source,
                        MeshCounts& counts);

/// Dual contouring (Ju et al. 2002) with a vertex a loop, so that the mesh is manifold; sharp edges and
/// corners are kept.
SurfaceMesh dualContouring(const MeshRequest& request, MeshCounts& counts);

}  // namespace edgewise::sdf
