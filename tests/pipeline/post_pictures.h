// Pictures for the tests of filters, and what they should become.
#pragma once

#include <cmath>
#include <functional>
#include <glm/common.hpp>

#include "pipeline/methods/post_process.h"

namespace edgewise::test {

inline ImageBuffer makePicture(int width, int height, const std::function<glm::dvec3(int, int)>& color) {
    ImageBuffer image({0, 0, width, height});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.rgba[image.index(x, y)] = glm::dvec4(color(x, y), 1.0);
    return image;
}

inline ImageBuffer filtered(ImageBuffer image, const char* method) {
    Progress progress;
    std::vector<StageTime> stages;
    makePostProcess(parseMethod(method)).apply(image, progress, stages);
    return image;
}

/// White below the line y = offset + slope x; the pixels' centres decide.
inline ImageBuffer sampledHalfPlane(int side, double offset, double slope) {
    return makePicture(side, side, [&](int x, int y) {
        return glm::dvec3(y + 0.5 > offset + slope * (x + 0.5) ? 1.0 : 0.0);
    });
}

/// How much of the pixel lies below the line: exact where |slope| <= 1, by its height over the columns.
inline double coverageBelow(int x, int y, double offset, double slope) {
    constexpr int kColumns = 4096;
    double sum = 0.0;
    for (int i = 0; i < kColumns; ++i)
        sum += glm::clamp(y + 1.0 - (offset + slope * (x + (i + 0.5) / kColumns)), 0.0, 1.0);
    return sum / kColumns;
}

/// Root of the mean squared difference from the exact coverage, `margin` pixels off the border.
inline double errorOfHalfPlane(const ImageBuffer& image, double offset, double slope, int margin) {
    double squares = 0.0;
    int count = 0;
    for (int y = margin; y < image.box.height() - margin; ++y)
        for (int x = margin; x < image.box.width() - margin; ++x, ++count) {
            const double e = image.rgba[image.index(x, y)].r - coverageBelow(x, y, offset, slope);
            squares += e * e;
        }
    return std::sqrt(squares / count);
}

inline ImageBuffer flipped(const ImageBuffer& image, bool columns) {
    ImageBuffer other(image.box);
    const int width = image.box.width(), height = image.box.height();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            other.rgba[other.index(x, y)] =
                image.rgba[image.index(columns ? width - 1 - x : x, columns ? y : height - 1 - y)];
    return other;
}

inline double largestDifference(const ImageBuffer& a, const ImageBuffer& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(a.rgba[i][c] - b.rgba[i][c]));
    return largest;
}

}  // namespace edgewise::test
