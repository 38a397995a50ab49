#include "data/generate/portable_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace edgewise::scenes {
namespace {

// long double carries 11 bits more than the functions under test: its own error does not show.
constexpr long double kTwoPiLong = 6.28318530717958647692528676655900577L;
constexpr std::uint64_t kSeed = 7;

TEST(PortableMath, CircleStaysInsideItsBound) {
    SplitMix64 random(kSeed);
    long double worst = 0.0L;
    int each_quadrant[4] = {};
    for (int i = 0; i < 200000; ++i) {
        const double turns = random.between(-4.0, 4.0);
        const long double angle = kTwoPiLong * (static_cast<long double>(turns) - std::floor(turns));
        const Vec2 p = onCircle(turns);
        worst = std::max({worst, std::abs(p.x - std::cos(angle)), std::abs(p.y - std::sin(angle))});
        ++each_quadrant[static_cast<int>(4.0 * (turns - std::floor(turns)))];
    }
    std::printf("seed %llu, worst %.3Lf x 2^-53\n", static_cast<unsigned long long>(kSeed), worst * 0x1p53L);
    EXPECT_LE(worst, 4.0L * 0x1p-53L);
    for (const int count : each_quadrant) EXPECT_GT(count, 40000);
}

TEST(PortableMath, QuarterTurnsAreExact) {
    for (int quarter = -8; quarter <= 8; ++quarter) {
        const Vec2 p = onCircle(0.25 * quarter);
        EXPECT_EQ(std::abs(p.x), quarter % 2 == 0 ? 1.0 : 0.0);
        EXPECT_EQ(std::abs(p.y), quarter % 2 == 0 ? 0.0 : 1.0);
    }
}

TEST(PortableMath, LogarithmStaysInsideItsBound) {
    long double worst = 0.0L;
    for (int i = 1; i <= 100000; ++i) {
        worst = std::max(
            worst, std::abs(static_cast<long double>(binaryLog(i)) - std::log2(static_cast<long double>(i))));
    }
    std::printf("worst %.3Lf x 2^-47\n", worst * 0x1p47L);
    EXPECT_LE(worst, 0x1p-47L);
    for (int k = 0; k < 31; ++k) EXPECT_EQ(binaryLog(std::ldexp(1.0, k)), k);
}

TEST(PortableMath, RandomNumbersAreThePublishedOnes) {
    SplitMix64 random(1234567);  // widely published outputs for this seed
    EXPECT_EQ(random.next(), 6457827717110365317u);
    EXPECT_EQ(random.next(), 3203168211198807973u);
    EXPECT_EQ(random.next(), 9817491932198370423u);
}

TEST(PortableMath, RandomAxesAreOrthonormal) {
    SplitMix64 random(kSeed);
    // Each component takes at most 8 roundings of values up to 2, so does each of the sums below: 32 * 2^-53
    // * 2.
    for (int i = 0; i < 10000; ++i) {
        const Axes axes = randomAxes(random);
        EXPECT_NEAR(dot(axes.u, axes.u), 1.0, 64 * 0x1p-53);
        EXPECT_NEAR(dot(axes.v, axes.v), 1.0, 64 * 0x1p-53);
        EXPECT_NEAR(dot(axes.u, axes.v), 0.0, 64 * 0x1p-53);
    }
}

}  // namespace
}  // namespace edgewise::scenes
