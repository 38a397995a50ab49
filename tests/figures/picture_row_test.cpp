// Pictures made smaller: what new pixels cannot hold goes, what they can stays.
#include "paper_figures/picture_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace edgewise::figures {
namespace {

ImageBuffer wave(double period_px) {
    ImageBuffer image({10, 20, 138, 148});
    for (int y = 20; y < 148; ++y)
        for (int x = 10; x < 138; ++x)
            image.rgba[image.index(x, y)] =
                glm::dvec4(0.5 + 0.5 * std::cos(2.0 * M_PI * (x + 0.5) / period_px));
    return image;
}

/// Half the distance between the darkest and the lightest, away from the borders.
double amplitude(const ImageBuffer& image) {
    double low = INFINITY, high = -INFINITY;
    for (int y = 8; y < image.box.y1 - 8; ++y)
        for (int x = 8; x < image.box.x1 - 8; ++x) {
            low = std::min(low, image.rgba[image.index(x, y)].r);
            high = std::max(high, image.rgba[image.index(x, y)].r);
        }
    return 0.5 * (high - low);
}

TEST(PictureRow, ShrunkKeepsConstantsAndDropsWhatWouldAlias) {
    ImageBuffer flat({0, 0, 64, 64});
    for (glm::dvec4& p : flat.rgba) p = glm::dvec4(0.25);
    for (const glm::dvec4& p : shrunk(flat, 4).rgba) EXPECT_NEAR(p.g, 0.25, 1e-14);
    EXPECT_EQ(shrunk(wave(64.0), 4).box.width(), 32);
    // A Gaussian of 3 px leaves exp(-2 (3 pi f)^2) of a wave; beyond three of its deviations it is cut, which
    // holds exp(-9/2) of it.
    const double cut = std::exp(-4.5);
    for (const double period : {64.0, 16.0, 8.0, 5.0, 4.1}) {
        const double left = 0.5 * std::exp(-2.0 * std::pow(3.0 * M_PI / period, 2));
        EXPECT_NEAR(amplitude(shrunk(wave(period), 4)), left, 0.02 * left + cut) << period;
    }
    EXPECT_LT(amplitude(shrunk(wave(5.0), 4)), 0.01);  // which would alias to 20 px
}

}  // namespace
}  // namespace edgewise::figures
