#include "pipeline/blend.h"

#include <algorithm>
#include <cmath>

namespace edgewise {
namespace {

double toReal(FixedWeight w) {
    return std::ldexp(static_cast<double>(w), -kWeightBits);
}

/// Whether colours differ by more than the contract's contrast.
struct ContrastRange {
    glm::dvec3 low{HUGE_VAL}, high{-HUGE_VAL};
    void add(const glm::dvec3& color) { low = glm::min(low, color), high = glm::max(high, color); }
    bool edge() const {
        const glm::dvec3 span = high - low;
        return std::max({span.x, span.y, span.z}) > kEdgeContrast;
    }
};

}  // namespace

void blend(const WeightTile& tile, glm::dvec2 offset_px, const ShadeOwner& shade, ImageBuffer& image) {
    std::size_t pixel = 0;
    for (int y = tile.box.y0; y < tile.box.y1; ++y) {
        for (int x = tile.box.x0; x < tile.box.x1; ++x, ++pixel) {
            const glm::dvec2 sample = glm::dvec2(x + 0.5, y + 0.5) + offset_px;
            glm::dvec3 color(0.0);
            FixedWeight covered = 0;
            double half_covered = 0.0;
            ContrastRange range;
            for (std::size_t e = tile.offset[pixel]; e < tile.offset[pixel + 1]; ++e) {
                const OwnerWeight& entry = tile.entries[e];
                const Shade seen = shade(entry.owner, sample, tile.points.of(e));
                color += toReal(entry.weight) * seen.color;
                if (seen.alpha == 1.0)
                    covered += entry.weight;
                else
                    half_covered += toReal(entry.weight) * seen.alpha;
                range.add(seen.color);
            }
            const std::size_t i = image.index(x, y);
            image.rgba[i] = glm::dvec4(color, toReal(covered) + half_covered);
            image.edge[i] = range.edge() ? 1.0f : 0.0f;
        }
    }
}

}  // namespace edgewise
