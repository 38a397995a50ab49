// Exponents that are known, and a slope and its error worked out by hand.
#include "paper_figures/power_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace edgewise::figures {
namespace {

constexpr double kRounding = 1e-13;  ///< a few roundings of logarithms below 16

TEST(PowerFit, FindsTheLawBehindThePoints) {
    for (const double exponent : {-1.0, 0.0, 0.5, 1.0, 2.0}) {
        std::vector<glm::dvec2> points;
        for (double x = 2; x < 5000; x *= 3) points.emplace_back(x, 0.25 * std::pow(x, exponent));
        const auto fit = fitPower(points);
        ASSERT_TRUE(fit);
        EXPECT_NEAR(fit->exponent, exponent, kRounding);
        EXPECT_NEAR(fit->factor, 0.25, kRounding);
        EXPECT_NEAR(*fit->standard_error, 0.0, kRounding);
        EXPECT_NEAR(fit->least_local, exponent, kRounding);
        EXPECT_NEAR(fit->most_local, exponent, kRounding);
        EXPECT_NEAR(fit->at(700), 0.25 * std::pow(700, exponent), 1e-12 * std::pow(700, exponent));
    }
}

/// Logarithms (0, 0), (1, 0), (2, 3): slope 3/2, intercept -1/2, residuals 1/2, -1, 1/2, so the error is
/// sqrt(3/2 / 1 / 2).
TEST(PowerFit, TellsItsError) {
    const double e = std::exp(1.0);
    const std::vector<glm::dvec2> points{{1, 1}, {e, 1}, {e * e, e * e * e}};
    const auto fit = fitPower(points);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->exponent, 1.5, kRounding);
    EXPECT_NEAR(std::log(fit->factor), -0.5, kRounding);
    EXPECT_NEAR(*fit->standard_error, std::sqrt(0.75), kRounding);
    EXPECT_NEAR(fit->least_local, 0.0, kRounding);
    EXPECT_NEAR(fit->most_local, 3.0, kRounding);
}

TEST(PowerFit, NeedsTwoPlaces) {
    EXPECT_FALSE(fitPower({}));
    EXPECT_FALSE(fitPower(std::vector<glm::dvec2>{{3, 1}}));
    EXPECT_FALSE(fitPower(std::vector<glm::dvec2>{{3, 1}, {3, 2}}));
    const auto two = fitPower(std::vector<glm::dvec2>{{1, 1}, {2, 4}});
    ASSERT_TRUE(two);
    EXPECT_NEAR(two->exponent, 2.0, kRounding);
    EXPECT_FALSE(two->standard_error);
}

}  // namespace
}  // namespace edgewise::figures
