// Random scenes of float32 triangles, hard on purpose: what a file can hold that the screen finds difficult.
#pragma once

#include <cstdint>

#include "tests/property/world_scene.h"

namespace edgewise::property {

/// A scene and the pixels that it is around.
struct RandomWorld {
    WorldScene scene;
    PixelBox box;
};

/// The same for the same seed on every machine: at most about twenty triangles of a few ingredients each.
RandomWorld makeRandomWorld(std::uint64_t seed);

}  // namespace edgewise::property
