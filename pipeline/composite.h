// Layers over each other: "over" from front to back, in linear light.
//     colour = sum_k T_k alpha_k c_k + T_n c_background,  T_k = product of (1 - alpha_j) over the layers j <
//     k
// What ends a stack is there whole, whatever its material says of alpha: visibility has decided that.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "analytic/layer_stacks.h"
#include "pipeline/error.h"
#include "pipeline/shade.h"
#include "pipeline/shading_text.h"

namespace edgewise {

/// Throws FailureError naming the pixel that holds `at_px` where the stack has more than kMaxLayers
/// see-through layers.
inline void requireShadable(std::span<const Owner> layers, glm::dvec2 at_px) {
    if (layers.size() <= kMaxLayers + 1) return;
    throw FailureError(fmt::format("pixel {:.0f},{:.0f}", std::floor(at_px.x), std::floor(at_px.y)),
                       fmt::format("{} triangles are seen through each other, the limit is {}",
                                   layers.size() - 1, kMaxLayers));
}

/// Calls visit(k, share, colour) for each triangle of a stack, front to back, share = T_k alpha_k;
/// shade(owner) gives its Shade. Returns what is left for the background: 0 where the stack ends in a
/// triangle.
template <class ShadeLayer, class Visit>
double throughLayers(std::span<const Owner> layers, const ShadeLayer& shade, const Visit& visit) {
    double left = 1.0;
    for (std::size_t k = 0; k < layers.size(); ++k) {
        if (layers[k] == kBackground) return left;
        const Shade layer = shade(layers[k]);
        const bool last = k + 1 == layers.size();
        visit(k, f64::shareOf(left, layer.alpha, last), layer.color);
        left = f64::leftBehind(left, layer.alpha, last);
    }
    return left;
}

/// The colour of a stack over the background, and its alpha: the share that is not the background's.
template <class ShadeLayer>
Shade composite(std::span<const Owner> layers, const ShadeLayer& shade, const glm::dvec3& background) {
    if (layers.size() == 1)
        return layers[0] == kBackground ? Shade{background, 0.0} : Shade{shade(layers[0]).color, 1.0};
    glm::dvec3 color(0.0);
    const double left = throughLayers(
        layers, shade, [&](std::size_t, double share, const glm::dvec3& c) { color += share * c; });
    return {color + left * background, 1.0 - left};
}

}  // namespace edgewise
