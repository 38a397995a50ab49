// The smallest scene that still fails: triangles are dropped, then coordinates lose their bits.
#pragma once

#include <functional>

#include "tests/property/world_scene.h"

namespace edgewise::property {

using Fails = std::function<bool(const WorldScene&)>;

/// What is left of a scene that fails: no triangle can be dropped, no two nodes joined and no coordinate
/// rounded to fewer bits without making it hold; or `budget` scenes were tried.
WorldScene shrink(WorldScene scene, const Fails& fails, int budget = 3000);

/// Bits of the mantissa from its first to its last 1; 0 of 0.
int significantBits(float x);

}  // namespace edgewise::property
