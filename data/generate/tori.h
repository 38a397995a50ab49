// Tori: the closed, smooth, self-occluding model of the benchmarks, and the sequence of the NSAA paper's
// Figure 7.
#pragma once

#include "data/generate/gltf_file.h"

namespace edgewise::scenes {

/// One closed torus (radii 1 and 0.45) of 2 * around * tube triangles, lit, smooth normals, back faces
/// culled, tilted against the camera so that it hides part of itself; it spans the square picture from side
/// to side.
GltfFile makeTorus(std::uint32_t around, std::uint32_t tube);

/// Seven checkered tori (96 x 48 quads each) one behind the other, each turned further than the one before.
GltfFile makeTorusSequence();

}  // namespace edgewise::scenes
