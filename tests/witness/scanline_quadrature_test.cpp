// Who judges the judge: cases known by hand, sums, exchanged axes, and dice.
#include "tests/witness/scanline_quadrature.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/witness/local_scene.h"
#include "tests/witness/scene_builder.h"

namespace edgewise::witness {
namespace {

constexpr double kFar = 64;

ScreenScene leftOf(double x) {
    SceneBuilder builder;
    builder.add({{{-kFar, -kFar, 1}, {x, -kFar, 1}, {-kFar, kFar, 1}}});
    builder.add({{{x, -kFar, 1}, {x, kFar, 1}, {-kFar, kFar, 1}}});
    return builder.scene();
}

ScreenScene randomSoup(unsigned seed, int count, double size) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> at(-size, size), depth(0, 1);
    SceneBuilder builder;
    for (int k = 0; k < count; ++k)
        builder.add({{{at(random), at(random), depth(random)},
                      {at(random), at(random), depth(random)},
                      {at(random), at(random), depth(random)}}});
    return builder.scene();
}

Prefilter named(const std::string& name) {
    for (const Prefilter& filter : allPrefilters())
        if (filter.name == name) return filter;
    throw std::invalid_argument(name);
}

TEST(Witness, NormalisersAreTheKnownIntegrals) {
    const Real pi = std::numbers::pi_v<Real>;
    const std::map<std::string, Real> known = {
        {"box", 1},
        {"disk", pi / 4},
        {"tent", 1},
        {"cone", pi / 3},
        {"gaussian", 2 * pi / 2.25L * (1 - std::exp(-4.5L))},
        {"gaussian-separable", 2 * pi / 2.25L * std::pow(std::erf(3 / std::sqrt(2.0L)), 2)},
        {"bspline", 1},
        {"mitchell", 1},
        {"catmull-rom", 1},
        {"poly:1,-2,1", 4 * pi / 3}};
    for (const auto& [name, integral] : known) {
        const Estimate ours = ScanlineQuadrature(kernelLike(named(name))).normaliser();
        // Gaussian sigmas are the doubles nearest to 2/3: the integral moves by twice that rounding.
        const Real granted = name.starts_with("gaussian") ? 2 * integral * 0x1p-53L : 0;
        const Real cubic_granted =
            name == "mitchell" ? 8 * 0x1p-53L : 0;  // B and C likewise, weights <= 2 each axis
        EXPECT_LE(std::fabs(ours.value - integral), ours.error + granted + cubic_granted) << name;
        EXPECT_LT(ours.error, 1e-15L) << name;
    }
}

TEST(Witness, HalfPlanesAreKnownByHand) {
    const double x = 0.1875;
    const Real t = x;
    const std::map<std::string, Real> left = {
        {"box", 0.5L + t},
        {"tent", 0.5L + t - t * t / 2},
        {"disk", 0.5L + (std::asin(2 * t) + 2 * t * std::sqrt(1 - 4 * t * t)) / std::numbers::pi_v<Real>},
        {"gaussian-separable",
         0.5L + std::erf(t / (2.0L / 3 * std::sqrt(2.0L))) / (2 * std::erf(3 / std::sqrt(2.0L)))}};
    for (const auto& [name, weight] : left) {
        const Judgement judged = ScanlineQuadrature(kernelLike(named(name))).judge(leftOf(x), {0, 0});
        const Real granted = name.starts_with("gaussian") ? 0x1p-53L : 0;
        EXPECT_LE(std::fabs(judged.of(0) + judged.of(1) - weight), judged.error + granted) << name;
    }
}

TEST(Witness, TriangleAreasAreKnownByHand) {
    SceneBuilder builder;
    builder.add({{{10.25, 20.25, 0}, {10.75, 20.25, 0}, {10.25, 20.75, 0}}});  // 1/8, farther
    builder.add({{{10.25, 20.25, 1}, {10.5, 20.25, 1}, {10.25, 20.5, 1}}});    // 1/32, nearer
    const Judgement judged =
        ScanlineQuadrature(kernelLike(named("box"))).judge(builder.scene(), {10.5, 20.5});
    EXPECT_LE(std::fabs(judged.of(1) - 1.0L / 32), judged.error);
    EXPECT_LE(std::fabs(judged.of(0) - 3.0L / 32), judged.error);
    EXPECT_LE(std::fabs(judged.of(kBackground) - 7.0L / 8), judged.error);
    EXPECT_LT(judged.error, 1e-15L);
}

TEST(Witness, PiercingTrianglesMeetWhereTheirDepthsAreEqual) {
    SceneBuilder builder;
    const auto flat = builder.addPlane(DepthPlane{0, 0, 0.5}), tilted = builder.addPlane(DepthPlane{1, 0, 0});
    builder.addOnPlane({{{-kFar, -kFar}, {kFar, -kFar}, {0, kFar}}}, flat);
    builder.addOnPlane({{{-kFar, -kFar}, {kFar, -kFar}, {0, kFar}}}, tilted);  // nearer where x > 0.5
    const Judgement judged = ScanlineQuadrature(kernelLike(named("tent"))).judge(builder.scene(), {0, 0});
    EXPECT_LE(std::fabs(judged.of(1) - 0.125L), judged.error);
    EXPECT_LE(std::fabs(judged.of(0) - 0.875L), judged.error);
}

TEST(Witness, EqualDepthGoesToTheLowerIndex) {
    SceneBuilder builder;
    const auto plane = builder.addPlane(DepthPlane{0.1, 0.2, 0.3}),
               copy = builder.addPlane(DepthPlane{0.1, 0.2, 0.3});
    builder.addOnPlane({{{-1, -1}, {0.25, -1}, {-1, 3}}}, plane);
    builder.addOnPlane({{{-kFar, -kFar}, {kFar, -kFar}, {0, kFar}}}, copy);
    builder.addOnPlane({{{-kFar, -kFar}, {kFar, -kFar}, {0, kFar}}}, plane);
    const Judgement judged = ScanlineQuadrature(kernelLike(named("box"))).judge(builder.scene(), {0, 0});
    EXPECT_EQ(judged.of(2), 0);
    EXPECT_EQ(judged.of(kBackground), 0);
    EXPECT_GT(judged.of(0), 0.1L);
    EXPECT_GT(judged.of(1), 0.1L);
}

class EveryFilter : public testing::TestWithParam<Prefilter> {};

TEST_P(EveryFilter, WeightsSumToOneAndAxesMayBeExchanged) {
    const ScanlineQuadrature quadrature(kernelLike(GetParam()));
    Real worst_sum = 0, worst_swap = 0, worst_error = 0;
    std::size_t scanlines = 0, owners = 0;
    const auto begin = std::chrono::steady_clock::now();
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const ScreenScene scene = randomSoup(seed, 8, 2.5);
        const Judgement judged = quadrature.judge(scene, {0.5, -0.5});
        const Judgement swapped = quadrature.judge(swapAxes(scene), {-0.5, 0.5});
        const Real error = judged.error + swapped.error;
        EXPECT_LE(std::fabs(judged.sum() - 1), judged.weight.size() * judged.error) << "seed " << seed;
        for (const auto& [owner, w] : judged.weight) {
            EXPECT_LE(std::fabs(w - swapped.of(owner)), error) << "seed " << seed << " owner " << owner;
            worst_swap = std::max(worst_swap, std::fabs(w - swapped.of(owner)));
            owners += w != 0;
        }
        worst_sum = std::max(worst_sum, std::fabs(judged.sum() - 1));
        worst_error = std::max(worst_error, error);
        scanlines += judged.scanlines + swapped.scanlines;
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    fmt::print(
        "{}: |sum - 1| <= {:.1e}, |swap| <= {:.1e}, estimate <= {:.1e}, {:.1f} ms a judgement, {} "
        "scanlines\n",
        GetParam().name, double(worst_sum), double(worst_swap), double(worst_error),
        seconds.count() / 12 * 1e3, scanlines / 12);
    EXPECT_LT(worst_error, 1e-13L);
    EXPECT_GT(owners, 12u);
}

TEST_P(EveryFilter, DiceAgree) {
    constexpr int kThrows = 400000;
    const unsigned seed = 7;
    const ScreenScene scene = randomSoup(seed, 6, 2.0);
    const ScanlineQuadrature quadrature(kernelLike(GetParam()));
    const Kernel& kernel = quadrature.kernel();
    const Judgement judged = quadrature.judge(scene, {0, 0});
    const double radius = double(kernel.radius), square = 4 * radius * radius;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> at(-radius, radius);
    std::map<Owner, std::pair<double, double>> sums;
    for (int k = 0; k < kThrows; ++k) {
        const double x = at(random), y = at(random);
        if (kernel.disk && x * x + y * y >= radius * radius) continue;
        const double w = double(kernel.shape(x, y) / quadrature.normaliser().value) * square;
        auto& [first, second] = sums[ownerAt(scene, {x, y})];
        first += w;
        second += w * w;
    }
    double worst = 0;
    for (const auto& [owner, moments] : sums) {
        const double mean = moments.first / kThrows;
        const double standard_error = std::sqrt((moments.second / kThrows - mean * mean) / kThrows);
        worst = std::max(worst, std::fabs(mean - double(judged.of(owner))) / standard_error);
    }
    fmt::print("{}: {} owners within {:.2f} standard errors, seed {}\n", GetParam().name, sums.size(), worst,
               seed);
    EXPECT_GE(sums.size(), 3u);
    EXPECT_LT(worst, 4.5);  // 7e-6 a weight by chance, and the seed is fixed
}

INSTANTIATE_TEST_SUITE_P(Witness, EveryFilter, testing::ValuesIn(allPrefilters()), [](const auto& one) {
    std::string name;
    for (char c : one.param.name.substr(0, one.param.name.find(':')))
        if (c != '-') name += c;
    return name;
});

}  // namespace
}  // namespace edgewise::witness
