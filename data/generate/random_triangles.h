// Random overlapping triangles: the benchmark of visibility.
#pragma once

#include "data/generate/gltf_file.h"

namespace edgewise::scenes {

/// How many of `count` triangles cover a point of the picture, on average.
inline constexpr double kDepthComplexity = 4.0;

/// `count` unlit triangles, placed and turned freely (they pierce each other), each of one random colour,
/// both sides seen; 1024 x 1024 px at one world unit a pixel, as deep as wide. A triangle is three uniform
/// points on a circle of radius c in a uniformly random plane: mean area 3 c^2/(2 pi), mean projected area
/// half of it. c is uniform on [m/2, m], so E[c^2] = 7 m^2/12. Centres are uniform on the square widened by m
/// on each side, so that inside the picture the depth complexity is the same everywhere:
///     D = count E[projected area]/(1024 + 2 m)^2 = 7 count m^2/(16 pi (1024 + 2 m)^2)
/// and m follows from D = 4. SplitMix64, seeded with `count`.
GltfFile makeRandomTriangles(std::uint32_t count);

/// The m above, in pixels.
double greatestCircumradius(std::uint32_t count);

}  // namespace edgewise::scenes
