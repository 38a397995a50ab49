// Any bytes as a screen scene, degenerate on purpose: few coordinates, shared planes, duplicates, collinear
// points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "analytic/screen_triangle.h"

namespace edgewise::fuzz {

/// The scene lies around this sample and is judged there.
inline constexpr double kSamplePx = 8.5;
inline constexpr std::size_t kMostTriangles = 12;

/// Two bytes of scene (the lattice that corners lie on, how far apart near-coincident planes are), then ten
/// bytes a triangle: how its plane comes about, six coordinates, three depths. Bytes that are missing are 0.
ScreenScene sceneFromBytes(std::span<const std::uint8_t> bytes);

}  // namespace edgewise::fuzz
