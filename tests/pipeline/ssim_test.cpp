// SSIM against scikit-image, and against the formula where a hand can follow it.
#include "pipeline/judge/ssim.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/srgb.h"
#include "tests/pipeline/metric_pictures.h"

namespace edgewise::judge {
namespace {

using namespace test;

constexpr double kAgreement = 1e-6;  // the contract's, with scikit-image

// Golden: scikit-image 0.19.3 (Debian 12's python3-skimage), structural_similarity(a, b,
// gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1, channel_axis=-1) of the same
// pictures in float64, clamped to [0, 1] and sRGB-encoded.
TEST(Ssim, AgreesWithScikitImage) {
    const struct {
        const char* name;
        PicturePair pair;
        double expected;
    } cases[] = {{"disk", diskPair(), 0.722473295746523},
                 {"checkers", checkerPair(), 0.636458137674011},
                 {"noise", noisePair(), 0.037077254094894},
                 {"beyond [0, 1]", beyondPair(), 0.688672980293603}};
    double worst = 0.0;
    for (const auto& one : cases) {
        const double found = ssim(one.pair.image, one.pair.reference);
        EXPECT_NEAR(found, one.expected, kAgreement) << one.name;
        worst = std::max(worst, std::abs(found - one.expected));
    }
    fmt::print("worst difference from scikit-image: {:.3g}\n", worst);
}

TEST(Ssim, OfAPictureWithItselfIsOne) {
    const PicturePair pair = diskPair();
    EXPECT_DOUBLE_EQ(ssim(pair.image, pair.image), 1.0);
}

TEST(Ssim, IsSymmetric) {
    const PicturePair pair = checkerPair();
    EXPECT_EQ(ssim(pair.image, pair.reference), ssim(pair.reference, pair.image));
}

// No variance: what is left is (2 x y + C1) / (x^2 + y^2 + C1). Rounding leaves a variance of some 2^-50 over
// C2 = 9e-4.
TEST(Ssim, OfTwoColoursIsTheirLuminanceTerm) {
    const double x = encodeSrgb(0.5), y = encodeSrgb(0.2);
    const double expected = (2.0 * x * y + 1e-4) / (x * x + y * y + 1e-4);
    const auto found =
        ssim(constantPicture(12, 13, glm::dvec3(0.5)), constantPicture(12, 13, glm::dvec3(0.2)));
    EXPECT_NEAR(found, expected, 1e-11);
}

// Beyond a border are its own values, so one row is as good as eleven that are alike.
TEST(Ssim, OfLessThanAWindowGoesOnBeyondTheBorder) {
    const auto rows = [](int height, double scale) {
        return makePicture(20, height, [&](int x, int) { return glm::dvec3(scale * (x * x % 7)); });
    };
    const double low = ssim(rows(1, 0.1), rows(1, 0.125));
    EXPECT_LT(low, 1.0);
    EXPECT_DOUBLE_EQ(low, ssim(rows(11, 0.1), rows(11, 0.125)));
    EXPECT_DOUBLE_EQ(low, ssim(rows(10, 0.1), rows(10, 0.125)));
}

}  // namespace
}  // namespace edgewise::judge
