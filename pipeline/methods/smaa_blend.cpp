// SMAA's last pass: a pixel is mixed with its neighbours across the edges around it.
#include <glm/common.hpp>

#include <algorithm>

#include "pipeline/decode_image.h"
#include "pipeline/methods/smaa.h"
#include "pipeline/srgb.h"

namespace edgewise {
namespace {

/// How much of each neighbour belongs into a pixel, in [0, 1].
struct Shares {
    double right, below, left, above;

    Shares(const SmaaWeights& weights, int x, int y)
        : right(weights.at(x + 1, y).w / 255.0),
          below(weights.at(x, y + 1).y / 255.0),
          left(weights.at(x, y).z / 255.0),
          above(weights.at(x, y).x / 255.0) {}

    bool none() const { return right + below + left + above == 0.0; }
    bool horizontal() const { return std::max(right, left) > std::max(below, above); }
};

glm::dvec4 encoded(const glm::dvec4& linear) {
    return {encodeSrgb(linear.r), encodeSrgb(linear.g), encodeSrgb(linear.b), linear.a};
}

glm::dvec4 decoded(const glm::dvec4& color) {
    return {decodeSrgb(color.r), decodeSrgb(color.g), decodeSrgb(color.b), color.a};
}

/// The mixture with the two neighbours of the axis that has the larger share: each as much as its share, and
/// the two mixtures in the ratio of the shares.
template <class At>
glm::dvec4 mixture(const Shares& shares, const At& at) {
    const bool horizontal = shares.horizontal();
    const double first = horizontal ? shares.right : shares.below;
    const double second = horizontal ? shares.left : shares.above;
    const glm::dvec4 here = at(0, 0);
    const glm::dvec4 with_first = glm::mix(here, horizontal ? at(1, 0) : at(0, 1), first);
    const glm::dvec4 with_second = glm::mix(here, horizontal ? at(-1, 0) : at(0, -1), second);
    return (with_first * first + with_second * second) / (first + second);
}

}  // namespace

void blendNeighbours(const SmaaWeights& weights, const SmaaSettings& settings, ImageBuffer& image,
                     Progress& progress) {
    const int width = weights.width(), height = weights.height();
    auto out = image.rgba;
    forRows("blend", height, progress, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const Shares shares(weights, x, y);
            if (shares.none()) continue;
            const auto at = [&](int dx, int dy) {
                const int column = std::clamp(x + dx, 0, width - 1), row = std::clamp(y + dy, 0, height - 1);
                const glm::dvec4& color = image.rgba[static_cast<std::size_t>(row) * width + column];
                return settings.gamma_blend ? encoded(color) : color;
            };
            const glm::dvec4 mixed = mixture(shares, at);
            out[static_cast<std::size_t>(y) * width + x] = settings.gamma_blend ? decoded(mixed) : mixed;
        }
    });
    image.rgba = std::move(out);
}

}  // namespace edgewise
