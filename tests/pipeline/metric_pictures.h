// Pairs of pictures that metrics are tried on. Only + - * / and comparisons make them, so that any program
// that follows the formulas has the same doubles.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "pipeline/image_buffer.h"

namespace edgewise::test {

struct PicturePair {
    ImageBuffer image, reference;
};

/// color(x, y) at each pixel; alpha 1, no edges.
template <class Color>
ImageBuffer makePicture(int width, int height, const Color& color) {
    ImageBuffer image({0, 0, width, height});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.rgba[image.index(x, y)] = glm::dvec4(glm::dvec3(color(x, y)), 1.0);
    return image;
}

inline ImageBuffer constantPicture(int width, int height, const glm::dvec3& color) {
    return makePicture(width, height, [&](int, int) { return color; });
}

/// 40 x 32: ramps across, down and along, and a disk that covers them.
inline ImageBuffer diskPicture(double cx, double cy, double radius, const glm::dvec3& inside) {
    return makePicture(40, 32, [&](int x, int y) {
        const double dx = x - cx, dy = y - cy;
        if (dx * dx + dy * dy < radius * radius) return inside;
        return glm::dvec3(x / 39.0, y / 31.0, (x + y) / 70.0);
    });
}

/// The disk moved, shrunk and dimmed.
inline PicturePair diskPair() {
    return {diskPicture(21.25, 15.5, 9.0, {0.75, 0.5, 0.125}),
            diskPicture(20.0, 16.0, 9.5, {1.0, 0.5, 0.0625})};
}

/// The same with values from -1 to 2.
inline PicturePair beyondPair() {
    PicturePair pair = diskPair();
    for (ImageBuffer* picture : {&pair.image, &pair.reference})
        for (glm::dvec4& pixel : picture->rgba) pixel = glm::dvec4(glm::dvec3(pixel) * 3.0 - 1.0, 1.0);
    return pair;
}

/// 31 x 27, squares of 3 px.
inline ImageBuffer checkerPicture(const glm::dvec3& odd, const glm::dvec3& even) {
    return makePicture(31, 27, [&](int x, int y) { return (x / 3 + y / 3) % 2 == 1 ? odd : even; });
}

/// Other colours on the same squares.
inline PicturePair checkerPair() {
    return {checkerPicture({0.5, 0.25, 0.125}, {0.0625, 0.5, 0.75}),
            checkerPicture({0.5, 0.5, 0.125}, {0.0, 0.5, 1.0})};
}

/// 48 x 40, 0.5 +- span/2 by the linear congruential generator s = 1664525 s + 1013904223 mod 2^32, a step
/// for R, G and B of each pixel.
inline ImageBuffer noisePicture(std::uint32_t seed, double span) {
    return makePicture(48, 40, [&](int, int) {
        glm::dvec3 color;
        for (int c = 0; c < 3; ++c) {
            seed = seed * 1664525u + 1013904223u;
            color[c] = 0.5 + span * (seed * 0x1p-32 - 0.5);
        }
        return color;
    });
}

inline PicturePair noisePair() {
    return {noisePicture(7, 0.75), noisePicture(12345, 0.25)};
}

}  // namespace edgewise::test
