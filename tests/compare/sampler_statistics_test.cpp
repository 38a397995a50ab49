// The interval of a bias and the error where edges are few, on errors of known distribution.
#include "pipeline/compare/sampler_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace edgewise::compare {
namespace {

/// Independent normal errors of deviation `sigma`, the same in R, G and B.
std::vector<glm::dvec3> noise(std::mt19937& random, int pixels, double bias, double sigma) {
    std::normal_distribution<double> normal(bias, sigma);
    std::vector<glm::dvec3> errors(pixels);
    for (glm::dvec3& e : errors) e = glm::dvec3(normal(random));
    return errors;
}

double mean(const std::vector<glm::dvec3>& errors) {
    double sum = 0.0;
    for (const glm::dvec3& e : errors) sum += e.x;
    return sum / double(errors.size());
}

TEST(SamplerStatistics, TheIntervalHoldsTheBiasInNineteenOfTwentyTrials) {
    constexpr int kTrials = 1000, kWidth = 68, kHeight = 61;  // blocks are cut at both borders
    std::mt19937 random(7);
    int held = 0;
    double width = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
        const auto errors = noise(random, kWidth * kHeight, 0.01, 0.5);
        const double half = biasHalfWidth(errors, kWidth).value();
        held += std::fabs(mean(errors) - 0.01) < half;
        width += half / kTrials;
    }
    // Of 1000 trials 950 +- 7; Student's quantile for 72 blocks would be 1.7 % wider: 4.6 more.
    EXPECT_NEAR(held, 948, 28);
    // 0.3 % by chance; a root is biased by 0.4 %, and the cut blocks weigh a little otherwise.
    EXPECT_NEAR(width, 1.96 * 0.5 / std::sqrt(double(kWidth * kHeight)), 0.03 * width);
}

TEST(SamplerStatistics, NeighboursThatShareSamplesWidenTheInterval) {
    constexpr int kSize = 128;
    std::mt19937 random(8);
    auto errors = noise(random, kSize * kSize, 0.0, 1.0);
    const double apart = biasHalfWidth(errors, kSize).value();
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) errors[y * kSize + x] = errors[(y & ~3) * kSize + (x & ~3)];
    // Squares of 4x4 alike: the deviation of the mean is 4 times as large; 256 blocks tell either to 4.4 %,
    // the ratio to 6.2 %.
    EXPECT_NEAR(biasHalfWidth(errors, kSize).value() / apart, 4.0, 4.0 * 0.2);
}

TEST(SamplerStatistics, FewBlocksHaveNoInterval) {
    std::mt19937 random(9);
    EXPECT_FALSE(biasHalfWidth(noise(random, 32 * 32, 0.0, 1.0), 32));
}

TEST(SamplerStatistics, TheErrorWhereEdgesAreFew) {
    const std::vector<glm::dvec3> errors{
        glm::dvec3(100.0), {3.0, 0.0, 0.0}, {0.0, 0.0, -3.0}, glm::dvec3(50.0)};
    const std::vector<EdgeClass> classes{EdgeClass::kOthers, EdgeClass::kFew, EdgeClass::kFew,
                                         EdgeClass::kNoEdge};
    const auto error = fewEdgesError(errors, classes);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->pixels, 2u);
    EXPECT_DOUBLE_EQ(error->rmse, std::sqrt(18.0 / 6.0));
    EXPECT_FALSE(fewEdgesError(errors, std::vector<EdgeClass>(4, EdgeClass::kOthers)));
}

}  // namespace
}  // namespace edgewise::compare
