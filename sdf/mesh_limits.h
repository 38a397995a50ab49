// How far a mesh may be off its surface.
#pragma once

namespace edgewise::sdf {

/// Lengths in the world.
struct MeshLimits {
    double sharp;   ///< by sharp edges
    double smooth;  ///< elsewhere
};

}  // namespace edgewise::sdf
