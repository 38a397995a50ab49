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
        const double found = ssim(one.pair.image, one.pair.reference).value();
        EXPECT_NEAR(found, one.expected, kAgreement) << one.name;
        worst = std::max(worst, std::abs(found - one.expected));
    }
    fmt::print("worst difference from scikit-image: {:.3g}\n", worst);
}

TEST(Ssim, OfAPictureWithItselfIsOne) {
    const PicturePair pair = diskPair();
    EXPECT_DOUBLE_EQ(ssim(pair.image, pair.image).value(), 1.0);
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
    EXPECT_NEAR(found.value(), expected, 1e-11);
}

TEST(Ssim, NeedsAWindow) {
    const glm::dvec3 gray(0.5);
    EXPECT_FALSE(ssim(constantPicture(10, 40, gray), constantPicture(10, 40, gray)));
    EXPECT_FALSE(ssim(constantPicture(40, 10, gray), constantPicture(40, 10, gray)));
    EXPECT_TRUE(ssim(constantPicture(11, 11, gray), constantPicture(11, 11, gray)));
}

}  // namespace
}  // namespace edgewise::judge
