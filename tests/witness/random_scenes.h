// Random scenes that are hard on purpose, each around one pixel far from the origin.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "analytic/screen_triangle.h"

namespace edgewise::witness {

enum class SceneKind {
    kPiercing,             ///< random triangles in random depths
    kCyclic,               ///< bars that lie over each other in a ring
    kClosedMesh,           ///< a projected torus, back faces culled
    kClosedMeshBothSides,  ///< the same with its back faces
    kFan,                  ///< triangles around one vertex, on a sample or on a pixel's corner
    kTJunctions,           ///< bricks of one plane
    kCoplanarDuplicates,   ///< a quad's two triangulations and decals on one plane
    kSlivers,              ///< down to 1e-5 px thin
    kAxisAligned,          ///< sides on pixel borders and through samples
    kNearCoincident,       ///< planes 1e-6 to 1e-13 apart
    kTiny,                 ///< triangles of 1e-4 px
    kHuge,                 ///< corners up to 1e6 px away
    kStar,                 ///< hundreds of edges through one point
    kMixed                 ///< some of all the small ones over each other
};

std::vector<SceneKind> allSceneKinds();
std::string nameOf(SceneKind kind);

struct RandomScene {
    SceneKind kind;
    std::uint64_t seed;
    ScreenScene scene;
    glm::ivec2 centre;               ///< the pixel that the scene is around
    std::vector<glm::ivec2> pixels;  ///< worth judging: the centre and some neighbours
};

/// The same for the same seed on every machine. `extent` is the number of edges of a star.
RandomScene makeRandomScene(SceneKind kind, std::uint64_t seed, int extent = 200);

/// The scene `factor` times as large about the corner of its centre pixel; a power of two, so that the grid
/// and the depths hold. Huge ones stay as they are: they fill any window, and would leave the guard band.
RandomScene magnified(RandomScene random, int factor);

}  // namespace edgewise::witness
