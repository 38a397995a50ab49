// The product's weights of one sample, from its public interface: visible map, then closed forms.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <vector>

#include "analytic/pixel_weights.h"
#include "analytic/row_owners.h"
#include "analytic/visibility.h"

namespace edgewise::witness {

struct ProductWeights {
    std::vector<OwnerWeight> weights;  ///< ascending owners
    std::uint64_t terms = 0, label_conflicts = 0;
    std::size_t segments = 0;  ///< segments of the map
};

/// A window that holds the support of every sample with |sample - centre| <= reach px.
inline Window windowAround(glm::dvec2 centre_px, double reach_px) {
    const auto lo = [&](double c) { return int(std::floor(c - reach_px)) - 1; };
    const auto hi = [&](double c) { return int(std::ceil(c + reach_px)) + 1; };
    return {lo(centre_px.x), lo(centre_px.y), hi(centre_px.x), hi(centre_px.y)};
}

inline ProductWeights productWeights(const VisibleMap& map, const Prefilter& filter, glm::ivec2 pixel) {
    const glm::dvec2 sample = glm::dvec2(pixel) + 0.5;
    PixelWeights engine(filter);
    engine.begin(sample, 1);
    for (const VisibleSegment& s : map.segments) engine.add(s, map.lines[s.line], s.left, s.right);
    const Owner base = ownerOnRow(map, pixel.y, sample.x + filter.radius);
    ProductWeights result;
    std::size_t offset[2] = {0, 0};
    engine.finish(&base, result.weights, offset);
    result.terms = engine.terms();
    result.label_conflicts = engine.label_conflicts();
    result.segments = map.segments.size();
    return result;
}

}  // namespace edgewise::witness
