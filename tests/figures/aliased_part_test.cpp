#include "paper_figures/aliased_part.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paper_figures/fourier.h"

namespace edgewise::figures {
namespace {

constexpr double kFloat = 64 * 0x1p-24;  ///< of a transform of float32 over log2 of some thousand samples

std::vector<double> wave(int side, int bins_x, int bins_y) {
    std::vector<double> values;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            values.push_back(std::cos(2 * M_PI * (bins_x * x + bins_y * y + 0.25) / side));
    return values;
}

TEST(BeyondFrequency, KeepsWhatIsBeyondAlongAnyAxisAndNothingElse) {
    constexpr int kSide = 48;
    for (const auto& [x, y, kept] : {std::tuple(0, 0, false),
                                     {3, 5, false},
                                     {12, 12, false},
                                     {13, 0, true},
                                     {2, -13, true},
                                     {24, 24, true},
                                     {-12, 11, false}}) {
        const std::vector<double> values = wave(kSide, x, y), high = beyondFrequency(values, kSide, 0.25);
        for (std::size_t i = 0; i < values.size(); ++i)
            ASSERT_NEAR(high[i], kept ? values[i] : 0.0, kFloat) << x << ' ' << y;
    }
}

FinePicture pictureOfWave(int side_px, int per_px, double cycles_per_px) {
    FinePicture fine;
    fine.per_px = per_px;
    fine.picture = ImageBuffer({10, 20, 10 + side_px, 20 + side_px});
    for (int y = 0; y < side_px * per_px; ++y)
        for (int x = 0; x < side_px * per_px; ++x)
            fine.luminance.push_back(0.5 + 0.5 * std::cos(2 * M_PI * cycles_per_px * x / per_px));
    return fine;
}

TEST(AliasedPartTest, IsAllOfAWaveAboveNyquistAndNothingOfOneBelow) {
    // The fade over 16 px spreads a wave over about 1/16 cycle/px; these are 0.2 away from Nyquist.
    const AliasedPart above = aliasedPart(pictureOfWave(64, 4, 0.7), 16);
    EXPECT_NEAR(above.share, 1.0, 0.01);
    EXPECT_NEAR(above.rms, 0.5 * M_SQRT1_2, 0.01);
    const AliasedPart below = aliasedPart(pictureOfWave(64, 4, 0.3), 16);
    EXPECT_LT(below.share, 1e-4);
    EXPECT_EQ(above.picture.box.x0, 26);
    EXPECT_EQ(above.picture.box.width(), 32);
}

TEST(AliasedPartTest, OfAFlatPictureIsNothing) {
    const AliasedPart flat = aliasedPart(pictureOfWave(32, 2, 0.0), 8);
    EXPECT_EQ(flat.rms, 0.0);
    EXPECT_EQ(flat.share, 0.0);
}

}  // namespace
}  // namespace edgewise::figures
