// FLIP against direct two-dimensional sums, and against colours whose difference is known.
#include "pipeline/judge/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/pipeline/metric_pictures.h"

namespace edgewise::judge {
namespace {

using namespace test;

double meanFlip(const PicturePair& pair) {
    const std::vector<double> map = flipMap(pair.image, pair.reference);
    return std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
}

// Golden: a NumPy program that follows the paper without its short cuts: whole YCxCz, two-dimensional kernels
// of 21 x 21 and 19 x 19 taps (scipy.ndimage.correlate, mode 'nearest'), 67 pixels a degree. Its constants,
// kernel radii, normalisation and border are the published implementation's; that implementation itself was
// not run, for lack of its test pair.
TEST(Flip, AgreesWithDirectSums) {
    const struct {
        const char* name;
        PicturePair pair;
        double mean, at_13_11, at_0_0;
    } cases[] = {
        {"disk", diskPair(), 0.173354203666908, 0.599459760925399, 0.0},
        {"checkers", checkerPair(), 0.378809623935260, 0.446528208198319, 0.324765341594414},
        {"noise", noisePair(), 0.286500140251383, 0.407983129859634, 0.451506908233529},
        {"beyond [0, 1]", beyondPair(), 0.150513518841707, 0.612559719203233, 0.0},
    };
    constexpr double kSameFormula =
        1e-12;  // both in double: the sums' order differs, and a square root near 0
    for (const auto& one : cases) {
        const std::vector<double> map = flipMap(one.pair.image, one.pair.reference);
        EXPECT_NEAR(meanFlip(one.pair), one.mean, kSameFormula) << one.name;
        EXPECT_NEAR(map[one.pair.image.index(13, 11)], one.at_13_11, kSameFormula) << one.name;
        EXPECT_NEAR(map[0], one.at_0_0, kSameFormula) << one.name;
    }
}

TEST(Flip, OfAPictureWithItselfIsExactlyZero) {
    for (const PicturePair& pair : {diskPair(), noisePair()})
        for (const double error : flipMap(pair.image, pair.image)) EXPECT_EQ(error, 0.0);
}

TEST(Flip, IsSymmetricAndWithinItsRange) {
    for (const PicturePair& pair : {diskPair(), checkerPair(), noisePair(), beyondPair()}) {
        const std::vector<double> map = flipMap(pair.image, pair.reference);
        EXPECT_EQ(map, flipMap(pair.reference, pair.image));
        EXPECT_GE(std::ranges::min(map), 0.0);
        EXPECT_LE(std::ranges::max(map), 1.0);
    }
}

// Flat colours have no features, and blurring keeps them: colour alone is left. HyAB with Hunt's effect from
// the published L*a*b* values of sRGB's primaries (D65, four digits).
TEST(Flip, OfFlatColoursIsTheirColourDistance) {
    const glm::dvec3 green_lab(87.7347, -86.1827, 83.1793), blue_lab(32.2970, 79.1875, -107.8602),
        red_lab(53.2408, 80.0925, 67.2032), black_lab(0.0), white_lab(100.0, 0.0, 0.0);
    const auto distance = [](const glm::dvec3& p, const glm::dvec3& q) {
        const double hp = p.x / 100.0, hq = q.x / 100.0;
        return std::abs(p.x - q.x) + std::hypot(hp * p.y - hq * q.y, hp * p.z - hq * q.z);
    };
    const double largest = std::pow(distance(green_lab, blue_lab), 0.7);
    const struct {
        glm::dvec3 a, b, a_lab, b_lab;
    } cases[] = {{{0, 0, 0}, {1, 1, 1}, black_lab, white_lab},
                 {{0, 1, 0}, {0, 0, 1}, green_lab, blue_lab},
                 {{1, 0, 0}, {0, 1, 0}, red_lab, green_lab},
                 {{1, 0, 0}, {1, 1, 1}, red_lab, white_lab},
                 {{0, 0, 0}, {0, 0, 1}, black_lab, blue_lab}};
    int below_knee = 0;
    for (const auto& one : cases) {
        const double share = std::pow(distance(one.a_lab, one.b_lab), 0.7) / largest;
        const double expected = share < 0.4 ? 0.95 * share / 0.4 : 0.95 + 0.05 * (share - 0.4) / 0.6;
        below_knee += share < 0.4 ? 1 : 0;
        // Three roundings to 4 digits move a share by some 1e-5.
        EXPECT_NEAR(meanFlip({constantPicture(5, 4, one.a), constantPicture(5, 4, one.b)}), expected, 1e-4);
    }
    EXPECT_EQ(below_knee, 0);
    const double gray = std::pow(116.0 * (std::cbrt(0.5) - std::cbrt(0.495)), 0.7) / largest;
    EXPECT_LT(gray, 0.4);
    EXPECT_NEAR(meanFlip({constantPicture(5, 4, glm::dvec3(0.5)), constantPicture(5, 4, glm::dvec3(0.495))}),
                0.95 * gray / 0.4, 1e-4);
}

// Kernels know neither left nor top. Sums are taken from the other side: what differs by 2^-50 of a feature
// differs by 2^-25 of its square root, and less in colour.
TEST(Flip, TurnsWithThePictures) {
    const PicturePair pair = diskPair();
    const auto turned = [](const ImageBuffer& image) {
        ImageBuffer out = image;
        std::ranges::reverse(out.rgba);
        return out;
    };
    std::vector<double> map = flipMap(turned(pair.image), turned(pair.reference));
    std::ranges::reverse(map);
    const std::vector<double> straight = flipMap(pair.image, pair.reference);
    for (std::size_t i = 0; i < map.size(); ++i) EXPECT_NEAR(map[i], straight[i], 0x1p-25) << i;
}

TEST(Flip, TakesPicturesSmallerThanItsKernels) {
    const std::vector<double> map =
        flipMap(constantPicture(1, 1, {0, 0, 0}), constantPicture(1, 1, {1, 1, 1}));
    EXPECT_EQ(map.size(), 1u);
    EXPECT_GT(map[0], 0.96);
}

}  // namespace
}  // namespace edgewise::judge
