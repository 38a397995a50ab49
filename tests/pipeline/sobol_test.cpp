// Owen-scrambled Sobol samples: the net's property, the scrambling's, and how patterns are dealt to pixels.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "pipeline/pixel_patterns.h"
#include "pipeline/sobol.h"

namespace edgewise {
namespace {

/// Whether every elementary interval 2^-a x 2^-(k - a) holds exactly one of 2^k points.
bool isNet(const std::vector<glm::dvec2>& points, int k) {
    for (int a = 0; a <= k; ++a) {
        std::set<std::pair<int, int>> cells;
        for (const glm::dvec2& p : points)
            cells.emplace(static_cast<int>(p.x * (1 << a)), static_cast<int>(p.y * (1 << (k - a))));
        if (cells.size() != points.size()) return false;
    }
    return true;
}

TEST(Sobol, TheFirstPointsByHand) {
    const double expected[8][2] = {{0, 0},       {.5, .5},     {.25, .75},   {.75, .25},
                                   {.125, .625}, {.625, .125}, {.375, .375}, {.875, .875}};
    for (std::uint32_t i = 0; i < 8; ++i) {
        EXPECT_EQ(sobolPoint(i).x * 0x1p-32, expected[i][0]) << i;
        EXPECT_EQ(sobolPoint(i).y * 0x1p-32, expected[i][1]) << i;
    }
}

TEST(Sobol, EveryElementaryIntervalHoldsOnePoint) {
    for (int k = 0; k <= 10; ++k)
        for (const std::uint64_t seed : {0, 1, 77}) {
            const PixelPatterns patterns = sobolPatterns(1 << k, 4, seed);
            for (std::size_t i = 0; i < patterns.count(); ++i) {
                const auto points = patterns.pattern(i);
                EXPECT_TRUE(isNet({points.begin(), points.end()}, k)) << k << " " << seed << " " << i;
            }
        }
}

/// Any 2^k points of a (0, 2)-sequence that start at a multiple of 2^k are a net too.
TEST(Sobol, LaterBlocksAreNetsToo) {
    for (int k = 1; k <= 8; ++k)
        for (std::uint32_t block = 0; block < 16; ++block) {
            std::vector<glm::dvec2> points;
            for (std::uint32_t i = block << k; i < (block + 1) << k; ++i)
                points.push_back(
                    glm::dvec2(owenScrambled(sobolPoint(i).x, 5), owenScrambled(sobolPoint(i).y, 6)) *
                    0x1p-32);
            EXPECT_TRUE(isNet(points, k)) << k << " " << block;
        }
}

TEST(Sobol, ANetTestThatCanFail) {
    PixelPatterns patterns = sobolPatterns(64, 1, 0);
    patterns.at_px[7] = patterns.at_px[9];
    EXPECT_FALSE(isNet(patterns.at_px, 6));
}

/// Nested: the first bits of the result depend on the first bits of the value alone; and each is flipped or
/// not whatever the bits above say.
TEST(OwenScrambling, IsNestedAndUniform) {
    for (std::uint64_t key = 0; key < 50; ++key)
        for (int depth = 1; depth <= 32; ++depth) {
            const std::uint32_t value = static_cast<std::uint32_t>(mixed(key * 40 + depth));
            const std::uint32_t below = depth == 32 ? 0 : 0xffffffffu >> depth;
            EXPECT_EQ(owenScrambled(value, key) >> (32 - depth),
                      owenScrambled(value ^ below, key) >> (32 - depth));
            EXPECT_NE(owenScrambled(value, key), owenScrambled(value ^ (1u << (32 - depth)), key));
        }
    // Of each bit under the two values of the one above: four counts of n coins, 5 sigma = 2.5 sqrt(n).
    constexpr int kKeys = 4000;
    for (int depth = 1; depth < 32; ++depth) {
        std::map<std::pair<int, int>, int> flips;
        for (std::uint64_t key = 0; key < kKeys; ++key) {
            const std::uint32_t above = 1u << (32 - depth);
            const auto flipped = [&](std::uint32_t v) {
                return static_cast<int>((owenScrambled(v, key) ^ v) >> (31 - depth) & 1u);
            };
            ++flips[{flipped(0), flipped(above)}];
        }
        for (const auto& [coins, count] : flips)
            EXPECT_NEAR(count, kKeys / 4, 2.5 * std::sqrt(kKeys)) << depth;
    }
}

TEST(PixelPatterns, AreDealtAtRandomByPositionAndSeed) {
    const PixelPatterns patterns = sobolPatterns(4, 16, 3), other = sobolPatterns(4, 16, 4);
    EXPECT_NE(patterns.at_px, other.at_px);
    std::vector<int> count(16, 0);
    int same = 0, equal_neighbours = 0;
    constexpr int kSide = 128;
    for (int y = -5; y < kSide - 5; ++y)
        for (int x = -5; x < kSide - 5; ++x) {
            ++count[patterns.patternOf(x, y)];
            same += patterns.patternOf(x, y) == other.patternOf(x, y);
            equal_neighbours += patterns.patternOf(x, y) == patterns.patternOf(x + 1, y);
        }
    // 5 sigma of n draws with chance 1/16.
    const double n = kSide * kSide, margin = 5.0 * std::sqrt(n / 16.0);
    for (const int c : count) EXPECT_NEAR(c, n / 16, margin);
    EXPECT_NEAR(same, n / 16, margin);
    EXPECT_NEAR(equal_neighbours, n / 16, margin);
}

}  // namespace
}  // namespace edgewise
