#include "pipeline/compare/error_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "pipeline/srgb.h"
#include "pipeline/write_image.h"

namespace edgewise::compare {
namespace {

using Color = glm::dvec3;  ///< sRGB-encoded

/// Of even lightness steps from dark to light, each at its place.
constexpr int kStops = 6;
const std::array<Color, kStops> kAbsolute{Color{0.02, 0.02, 0.06}, {0.27, 0.07, 0.42}, {0.62, 0.16, 0.39},
                                          {0.89, 0.36, 0.20},      {0.98, 0.68, 0.12}, {0.99, 0.99, 0.75}};
const Color kGround{0.97, 0.97, 0.96}, kDarker{0.05, 0.25, 0.65}, kLighter{0.72, 0.07, 0.10};

/// 0 for kLeastShown or less, 1 for kMostShown or more.
double share(double error) {
    if (!(error > kLeastShown)) return 0.0;
    return std::min(1.0, std::log(error / kLeastShown) / std::log(kMostShown / kLeastShown));
}

Color absoluteColor(double s) {
    const double at = s * (kStops - 1);
    const int below = std::min(static_cast<int>(at), kStops - 2);
    return glm::mix(kAbsolute[below], kAbsolute[below + 1], at - below);
}
Color signedColor(double s) {
    return glm::mix(kGround, s < 0.0 ? kDarker : kLighter, std::abs(s));
}

template <class ColorOf>
std::vector<unsigned char> mapOf(const ImageBuffer& image, const ImageBuffer& reference, ColorOf&& color_of) {
    ImageBuffer map(image.box);
    for (std::size_t i = 0; i < map.rgba.size(); ++i) {
        const Color c = color_of(glm::dvec3(image.rgba[i]) - glm::dvec3(reference.rgba[i]));
        // encodeImage() encodes it again
        map.rgba[i] = glm::dvec4(decodeSrgb(c.r), decodeSrgb(c.g), decodeSrgb(c.b), 1.0);
    }
    WriteOptions options;
    options.width = map.box.width(), options.height = map.box.height();
    return encodeImage(map, ImageFormat::kPng, options);
}

template <class ColorAt>
std::string gradient(ColorAt&& color_at) {
    std::string stops;
    for (int k = 0; k <= 20; ++k) {
        const Color c = glm::round(color_at(k / 20.0) * 255.0);
        stops += fmt::format("{}rgb({},{},{})", k == 0 ? "" : ",", c.r, c.g, c.b);
    }
    return "linear-gradient(to right," + stops + ")";
}

}  // namespace

std::vector<unsigned char> signedErrorMap(const ImageBuffer& image, const ImageBuffer& reference) {
    return mapOf(image, reference, [](const glm::dvec3& error) {
        const double mean = (error.r + error.g + error.b) / 3.0;
        return signedColor(std::copysign(share(std::abs(mean)), mean));
    });
}

std::vector<unsigned char> absoluteErrorMap(const ImageBuffer& image, const ImageBuffer& reference) {
    return mapOf(image, reference, [](const glm::dvec3& error) {
        return absoluteColor(share(std::max({std::abs(error.r), std::abs(error.g), std::abs(error.b)})));
    });
}

std::string signedGradient() {
    return gradient([](double x) { return signedColor(2.0 * x - 1.0); });
}
std::string absoluteGradient() {
    return gradient([](double x) { return absoluteColor(x); });
}

}  // namespace edgewise::compare
