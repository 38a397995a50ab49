// Blending: weights times colours, summed in index order (NSAA section 3.3).
#pragma once

#include <cmath>
#include <span>

#include "pipeline/image_buffer.h"
#include "pipeline/shade.h"
#include "pipeline/shading_text.h"
#include "pipeline/weights.h"

namespace edgewise {

/// visit(entry, sample_px) for every entry of the tile, in order.
template <class Visit>
void forEachEntry(const WeightTile& tile, glm::dvec2 offset_px, const Visit& visit) {
    std::size_t pixel = 0;
    for (int y = tile.box.y0; y < tile.box.y1; ++y)
        for (int x = tile.box.x0; x < tile.box.x1; ++x, ++pixel)
            for (std::size_t e = tile.offset[pixel]; e < tile.offset[pixel + 1]; ++e)
                visit(e, glm::dvec2(x + 0.5, y + 0.5) + offset_px);
}

/// Writes the tile's pixels: colour = sum of w c over owners, the background among them; alpha = the sum of w
/// alpha, exact but for one rounding where all alphas are 0 or 1. Weights are never clamped.
/// shadeOf(entry) is an entry's Shade over the background where that shows through, alpha being how much of
/// it is not the background's. A template, so that nothing is called through pointers for every entry.
template <class ShadeOf>
void blend(const WeightTile& tile, const ShadeOf& shadeOf, ImageBuffer& image) {
    std::size_t pixel = 0;
    for (int y = tile.box.y0; y < tile.box.y1; ++y) {
        for (int x = tile.box.x0; x < tile.box.x1; ++x, ++pixel) {
            f64::PixelSum sum{glm::dvec3(0.0), 0, 0.0, glm::dvec3(HUGE_VAL), glm::dvec3(-HUGE_VAL)};
            for (std::size_t e = tile.offset[pixel]; e < tile.offset[pixel + 1]; ++e) {
                const Shade& seen = shadeOf(e);
                sum = f64::withOwner(sum, tile.entries[e].weight, seen.color, seen.alpha);
            }
            const std::size_t i = image.index(x, y);
            image.rgba[i] = glm::dvec4(sum.color, f64::alphaOf(sum));
            image.edge[i] = f64::contrastOf(sum) > kEdgeContrast ? 1.0f : 0.0f;
        }
    }
}

}  // namespace edgewise
