// The two test patterns of "Non-Sampled Anti-Aliasing" (Auzinger, Musialski, Preiner, Wimmer, 2013): flat,
// unlit, 1024 x 1024 px at one world unit a pixel.
#pragma once

#include "data/generate/gltf_file.h"

namespace edgewise::scenes {

/// Figure 4: concentric rings of equal area, so that the spatial frequency grows linearly to the rim:
///     r_k = 512 sqrt((k + 1)/126),  k = 0 ... 125; ring k lies between r_k and r_(k+1)
/// The black background shows through the hole, r < r_0, as one more zone of the same area. Each ring is 80
/// quads: 125 * 80 * 2 = 20,000 triangles. Even rings are white, odd ones black: texel k of a 128 x 1 texture
/// is ring k's colour, and u is constant along a ring, so that texture filtering changes nothing. The
/// outermost ring is white and 2.04 px wide.
GltfFile makeZonePlate();

/// Figure 5: black and white cells between lines at binary logarithms,
///     x_i = 1024 log2(1 + i)/log2(102),  i = 0 ... 101;    y_j = 1024 log2(1 + j)/log2(101),  j = 0 ... 100,
/// x to the right, y down, each rounded to 2^-13 px: doubling the index advances by a constant (153.5 and
/// 153.8 px), cells shrink from that at the top left to 2.2 px at the bottom right. Cell (i, j) is white
/// where i + j is even. 101 x 100 cells, 20,200 triangles; the triangles of the white cells come first.
GltfFile makeLogGrid();

}  // namespace edgewise::scenes
