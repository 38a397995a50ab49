#include "pipeline/blend.h"

#include <cmath>

#include "pipeline/shading_text.h"

namespace edgewise {
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
