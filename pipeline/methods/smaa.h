// SMAA 1x: settings, and the three passes that its files hold.
//
// Source   J. Jimenez, J. Echevarria, T. Sousa, D. Gutierrez, "SMAA: Enhanced Subpixel Morphological
//          Antialiasing", Eurographics 2012. Edges between pixels are found by contrast; each edge belongs to
//          a pattern, a line and what crosses its two ends; the pattern stands for a straight silhouette,
//          whose area inside the pixel (smaa_textures) is how much of the neighbour across the edge is mixed
//          in.
// Agrees   with the published shader where its texture coordinates and 8-bit codes / 255 are rounded right:
//          the same edges, weights within 1/255. Elsewhere a shader takes a search step more or less at the
//          end of a long line, ties of contrast fall either way, and bilinear weights are cut to 1/256.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>

#include "pipeline/image_buffer.h"
#include "pipeline/methods/texels.h"

namespace edgewise {

struct SmaaSettings {
    float threshold = 0.1f;  ///< of contrast, in the encoded picture
    int search_steps = 16;   ///< of two pixels each, along a horizontal or vertical edge, either way
    int diagonal_steps = 8;  ///< of one pixel each, along a diagonal, either way; 0: no diagonals are sought
    float corner_rounding = 0.25f;  ///< how much of a right angle is rounded off; 1: all of it
    bool color_edges = false;       ///< contrast of the channels, not of luma
    bool gamma_blend = false;       ///< neighbours are mixed sRGB-encoded, not linear
};

/// Bits of a pixel: an edge on its left, and one on its top.
using SmaaEdges = Texels<std::uint8_t>;
inline constexpr std::uint8_t kLeftEdge = 1, kTopEdge = 2;

/// What an 8-bit target keeps of a pixel's weights: x of the pixel above mixed into this one, y of this one
/// into the pixel above; z of the pixel on the left mixed into this one, w of this one into it. 255 is all.
using SmaaWeights = Texels<glm::u8vec4>;

SmaaEdges findEdges(const ImageBuffer& image, const SmaaSettings& settings, Progress& progress);

SmaaWeights weighEdges(const SmaaEdges& edges, const SmaaSettings& settings, Progress& progress);

/// Colour and alpha mixed by the weights; a pixel without any keeps its bits.
void blendNeighbours(const SmaaWeights& weights, const SmaaSettings& settings, ImageBuffer& image,
                     Progress& progress);

}  // namespace edgewise
