// Blending: weights times colours, summed in index order (NSAA section 3.3).
#pragma once

#include <cmath>
#include <span>

#include "pipeline/image_buffer.h"
#include "pipeline/shade.h"
#include "pipeline/shading_text.h"
#include "pipeline/weights.h"

namespace edgewise {

/// Writes the tile's pixels: colour = sum of w c over owners, the background among them; alpha = the sum of w
/// alpha, exact but for one rounding where all alphas are 0 or 1. Weights are never clamped.
/// shade(owner, sample_px, offsets_px) gives the Shade of an owner for a sample, over the background where
/// that shows through, its alpha being how much of it is not the background's: the mean over the sample +
/// offsets, or at the closest point if there are none. A template, so that nothing is called through pointers
/// for every pixel.
template <class ShadeOwner>
void blend(const WeightTile& tile, glm::dvec2 offset_px, const ShadeOwner& shade, ImageBuffer& image) {
    std::size_t pixel = 0;
    for (int y = tile.box.y0; y < tile.box.y1; ++y) {
        for (int x = tile.box.x0; x < tile.box.x1; ++x, ++pixel) {
            const glm::dvec2 sample = glm::dvec2(x + 0.5, y + 0.5) + offset_px;
            f64::PixelSum sum{glm::dvec3(0.0), 0, 0.0, glm::dvec3(HUGE_VAL), glm::dvec3(-HUGE_VAL)};
            for (std::size_t e = tile.offset[pixel]; e < tile.offset[pixel + 1]; ++e) {
                const OwnerWeight& entry = tile.entries[e];
                const Shade seen = shade(entry.owner, sample, tile.points.of(e));
                sum = f64::withOwner(sum, entry.weight, seen.color, seen.alpha);
            }
            const std::size_t i = image.index(x, y);
            image.rgba[i] = glm::dvec4(sum.color, f64::alphaOf(sum));
            image.edge[i] = f64::contrastOf(sum) > kEdgeContrast ? 1.0f : 0.0f;
        }
    }
}

}  // namespace edgewise
