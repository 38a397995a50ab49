// What --aov takes, and what it means.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace edgewise {

/// Of the nearest surface at the pixel's sample, unfiltered; of layers, the first whose alpha is not 0 there:
///   - depth, channel Z: the distance along the view axis in world units; kBackgroundDepth where nothing is.
///   - normal, channels N.X, N.Y, N.Z: what is shaded with, unit, world space, towards the viewer; else 0.
///   - index, channel `index` (uint32): the triangle's index; 4294967295 where nothing is.
///
/// Of all that the filter's support holds:
///   - owners, channel `owners`: how many have a weight other than 0. The background is one, a stack is one.
///   - cryptomatte, channels CryptoObject00.red to CryptoMaterial02.alpha: see cryptomatte.h.
enum class Aov { kDepth, kNormal, kIndex, kOwners, kCryptomatte };

/// In the order of their channels.
const std::vector<std::pair<std::string, Aov>>& aovNames();

inline constexpr double kBackgroundDepth = 1e10;  // as Blender writes it; a float32 without rounding

/// float32 or uint32 values that these add to each pixel.
std::size_t aovChannelCount(const std::set<Aov>& wanted);

}  // namespace edgewise
