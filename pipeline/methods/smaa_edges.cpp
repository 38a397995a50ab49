// SMAA's first pass: edges by contrast, less those that a much stronger edge nearby masks.
#include <glm/common.hpp>

#include <cmath>

#include "pipeline/methods/display_picture.h"
#include "pipeline/methods/smaa.h"

namespace edgewise {
namespace {

constexpr glm::vec3 kLumaWeights{0.2126f, 0.7152f, 0.0722f};
/// An edge that some edge nearby exceeds by more than this factor is none: the eye does not see it.
constexpr float kLocalContrast = 2.0f;

float contrast(float a, float b) {
    return std::abs(a - b);
}
float contrast(const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 difference = glm::abs(a - b);
    return std::max(std::max(difference.r, difference.g), difference.b);
}

/// Contrast of the pixel beyond the next one: of lumas the edge there, between the two; of colours, as
/// published, what tells it from the pixel itself.
float contrastBeyond(float, float next, float beyond) {
    return contrast(next, beyond);
}
float contrastBeyond(const glm::vec3& here, const glm::vec3&, const glm::vec3& beyond) {
    return contrast(here, beyond);
}

/// The edges of pixel (x, y). Nearby are its own four, and the next ones to the left and above.
template <class T>
std::uint8_t edgesOf(const Texels<T>& values, int x, int y, float threshold) {
    const T here = values.at(x, y), left = values.at(x - 1, y), top = values.at(x, y - 1);
    const float to_left = contrast(here, left), to_top = contrast(here, top);
    if (to_left < threshold && to_top < threshold) return 0;
    const float strongest = std::max(
        {to_left, to_top, contrast(here, values.at(x + 1, y)), contrast(here, values.at(x, y + 1)),
         contrastBeyond(here, left, values.at(x - 2, y)), contrastBeyond(here, top, values.at(x, y - 2))});
    const auto is_edge = [&](float delta) {
        return delta >= threshold && kLocalContrast * delta >= strongest;
    };
    return static_cast<std::uint8_t>((is_edge(to_left) ? kLeftEdge : 0) | (is_edge(to_top) ? kTopEdge : 0));
}

template <class T>
SmaaEdges edgesIn(const Texels<T>& values, float threshold, Progress& progress) {
    SmaaEdges edges(values.width(), values.height());
    forRows("edges", edges.height(), progress, [&](int y) {
        for (int x = 0; x < edges.width(); ++x) edges.texel(x, y) = edgesOf(values, x, y, threshold);
    });
    return edges;
}

Texels<glm::vec3> quantizedPicture(const EncodedPicture& encoded) {
    Texels<glm::vec3> colors(encoded.width(), encoded.height());
    tbb::parallel_for(0, colors.height(), [&](int y) {
        for (int x = 0; x < colors.width(); ++x) colors.texel(x, y) = quantized(encoded.at(x, y));
    });
    return colors;
}

}  // namespace

SmaaEdges findEdges(const ImageBuffer& image, const SmaaSettings& settings, Progress& progress) {
    const EncodedPicture encoded = encodePicture(image);
    if (settings.color_edges) return edgesIn(quantizedPicture(encoded), settings.threshold, progress);
    return edgesIn(lumaOf(encoded, kLumaWeights), settings.threshold, progress);
}

}  // namespace edgewise
