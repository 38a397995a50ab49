#include "analytic/transcendental.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

namespace edgewise {
namespace {

constexpr std::uint32_t kSeed = 754;
constexpr int kRounds = 400000;

/// |got - exact| in units of the last place of exact; long double resolves 2^-11 of one.
double ulps(double got, long double exact) {
    int exponent = 0;
    std::frexp(static_cast<double>(exact), &exponent);
    return static_cast<double>(std::abs(static_cast<long double>(got) - exact) /
                               std::ldexp(1.0L, exponent - 53));
}

void expectWithin(double bound, const char* name, const std::function<double(std::mt19937&)>& draw,
                  const std::function<double(double)>& got, const std::function<long double(double)>& exact) {
    std::mt19937 random(kSeed);
    double worst = 0, where = 0;
    for (int i = 0; i < kRounds; ++i) {
        const double x = draw(random);
        const double error = ulps(got(x), exact(x));
        if (error > worst) {
            worst = error;
            where = x;
        }
    }
    std::printf("%-6s worst %.3f ulp at %a (seed %u)\n", name, worst, where, kSeed);
    EXPECT_LE(worst, bound) << name;
}

double uniform(std::mt19937& random, double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
}
double logUniform(std::mt19937& random, double from, double to) {
    return std::exp2(uniform(random, from, to));
}

TEST(Transcendental, WithinTheirStatedUlps) {
    expectWithin(
        2, "exp", [](auto& r) { return uniform(r, -690, 690); }, f64::expReal,
        [](double x) { return std::exp(static_cast<long double>(x)); });
    expectWithin(
        2.5, "phi1", [](auto& r) { return logUniform(r, -60, 12); }, f64::phi1,
        [](double x) { return -std::expm1(-static_cast<long double>(x)) / x; });
    expectWithin(
        1, "log", [](auto& r) { return logUniform(r, -1000, 1000); }, f64::logReal,
        [](double x) { return std::log(static_cast<long double>(x)); });
    expectWithin(
        1, "log~1", [](auto& r) { return 1 + uniform(r, -0.4, 0.6) * logUniform(r, -40, 0); }, f64::logReal,
        [](double x) { return std::log(static_cast<long double>(x)); });
    expectWithin(
        2, "erf", [](auto& r) { return (r() % 2 ? 1 : -1) * logUniform(r, -40, 2.5); }, f64::erfReal,
        [](double x) { return std::erf(static_cast<long double>(x)); });
    expectWithin(
        4, "atanh", [](auto& r) { return logUniform(r, -50, 0); },
        [](double rest) { return f64::atanhOfParts(1 - rest, 1, 1 - (1 - rest)); },
        [](double rest) { return std::atanh(static_cast<long double>(1 - rest)); });
    expectWithin(
        4, "atanh0", [](auto& r) { return logUniform(r, -50, -1); },
        [](double x) { return f64::atanhOfParts(x, 1, 1 - x); },
        [](double x) { return std::atanh(static_cast<long double>(x)); });
}

TEST(Transcendental, Atan2InEveryQuadrant) {
    std::mt19937 random(kSeed);
    double worst = 0;
    int quadrants[4] = {};
    for (int i = 0; i < kRounds; ++i) {
        const double y = (random() % 2 ? 1 : -1) * logUniform(random, -20, 20),
                     x = (random() % 2 ? 1 : -1) * logUniform(random, -20, 20);
        ++quadrants[(y < 0) * 2 + (x < 0)];
        worst = std::max(worst, ulps(f64::atan2Real(y, x),
                                     std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
    }
    std::printf("atan2  worst %.3f ulp (seed %u)\n", worst, kSeed);
    EXPECT_LE(worst, 2.0);
    for (int count : quadrants) EXPECT_GT(count, kRounds / 5);
}

TEST(Transcendental, SpecialValues) {
    EXPECT_EQ(f64::phi1(0.0), 1.0);
    EXPECT_EQ(f64::expNegative(0.0), 1.0);
    EXPECT_EQ(f64::expNegative(1e308), 0.0);
    EXPECT_EQ(f64::logReal(1.0), 0.0);
    EXPECT_EQ(f64::erfReal(0.0), 0.0);
    EXPECT_EQ(f64::erfReal(40.0), 1.0);
    EXPECT_EQ(f64::erfReal(-40.0), -1.0);
    EXPECT_EQ(f64::atan2Real(0.0, 0.0), 0.0);
    EXPECT_EQ(f64::atan2Real(0.0, 1.0), 0.0);
    EXPECT_EQ(f64::atan2Real(0.0, -1.0), M_PI);
    EXPECT_EQ(f64::atan2Real(1.0, 0.0), M_PI / 2);
    EXPECT_EQ(f64::atan2Real(-1.0, 0.0), -M_PI / 2);
    EXPECT_EQ(f64::atan2Real(1.0, 1.0), M_PI / 4);
    EXPECT_EQ(f64::atan2Real(-1.0, -1.0), -0.75 * M_PI);
}

}  // namespace
}  // namespace edgewise
