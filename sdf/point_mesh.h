// Meshes of the surface of a field that is asked at many points at once.
#pragma once

#include <functional>
#include <optional>

#include "sdf/point_field.h"
#include "sdf/polygonize.h"
#include "sdf/tree.h"

namespace edgewise::sdf {

struct PointMeshRequest {
    const PointField& field;
    Lattice lattice;
    bool dual = true;                    ///< false: marching cubes
    std::function<void()> between = {};  ///< called again and again; may throw
};

/// With normals and, where the field has them, colours; the material is the first. `bound_holds`: false where
/// values were seen to change faster than the field's bound: every cell was looked at then. Throws SceneError
/// where the surface reaches the lattice's end.
SurfaceMesh meshOfPoints(const PointMeshRequest& request, MeshCounts& counts, bool& bound_holds);

/// A box around all that is inside, by the field's bound alone, within a cube of that half side around 0.
/// None where it reaches the cube's end; empty where there is nothing. Throws SceneError where values change
/// faster than the bound says.
std::optional<Box> boxOfPoints(const PointField& field, double half);

}  // namespace edgewise::sdf
