// The properties against closed forms, against integrals that share no code with them, and against Parseval.
#include "analytic/filter_properties.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/bessel.hpp>
#include <cmath>
#include <random>

#include "tests/analytic/kernel_truth.h"

namespace edgewise {
namespace {

constexpr double kDiagonal = 0.25 * M_PI;
/// Of sums of some hundred terms that are about 1 together.
constexpr double kRounding = 256 * 0x1p-53;

double sinc(double x) {
    return x == 0.0 ? 1.0 : std::sin(M_PI * x) / (M_PI * x);
}

FilterProperties propertiesOf(const char* name, double radius) {
    return FilterProperties(makePrefilter(name, radius, {}));
}

const std::vector<std::string> kAll{
    "box",     "disk",     "tent",        "cone",        "gaussian", "gaussian-separable",
    "bspline", "mitchell", "catmull-rom", "bc:0.5,0.25", "lanczos",  "poly:1,-3,3,-1"};

TEST(FilterTransform, MeetsClosedForms) {
    const double R = 1.5;
    const FilterProperties box = propertiesOf("box", R), tent = propertiesOf("tent", R),
                           disk = propertiesOf("disk", R), bspline = propertiesOf("bspline", R),
                           poly = propertiesOf("poly:1,-3,3,-1", R);
    for (double f = 0.0; f < 8.0; f += 0.0625)
        for (const double angle : {0.0, 0.3, kDiagonal}) {
            const double x = f * std::cos(angle), y = f * std::sin(angle), z = 2 * M_PI * f * R;
            EXPECT_NEAR(box.transform(f, angle), sinc(2 * R * x) * sinc(2 * R * y), kRounding) << f;
            EXPECT_NEAR(tent.transform(f, angle), std::pow(sinc(R * x) * sinc(R * y), 2), kRounding) << f;
            EXPECT_NEAR(bspline.transform(f, angle), std::pow(sinc(0.5 * R * x) * sinc(0.5 * R * y), 4),
                        kRounding)
                << f;
            // Bessel functions err by some ulps of their argument's phase
            const double bessel = kRounding + 4 * 0x1p-53 * z;
            if (z == 0.0) continue;
            EXPECT_NEAR(disk.transform(f, angle), 2 * boost::math::cyl_bessel_j(1, z) / z, bessel) << f;
            // Sonine: (1 - q^2)^3 on the disk gives 2^4 4! J_4(z) / z^4
            EXPECT_NEAR(poly.transform(f, angle), 384 * boost::math::cyl_bessel_j(4, z) / std::pow(z, 4),
                        bessel + (z < 1 ? 1e-12 : 0.0))
                << f;
        }
}

TEST(FilterTransform, OfABroadGaussianIsAGaussian) {
    const double sigma = 0.5, R = 5.0;  // beyond R e^(-50) is left out, of the disk and of the square
    for (const char* name : {"gaussian", "gaussian-separable"}) {
        const FilterProperties properties(makePrefilter(name, R, sigma));
        for (double f = 0.0; f < 1.0; f += 0.0625)
            EXPECT_NEAR(properties.transform(f, 0.7), std::exp(-2 * std::pow(M_PI * sigma * f, 2)), kRounding)
                << name;
    }
}

TEST(FilterTransform, IsOneAtZeroForEveryKernel) {
    for (const std::string& name : kAll)
        for (const double R : {0.5, 2.0, 7.25})
            EXPECT_NEAR(FilterProperties(makePrefilter(name, R, {})).transform(0.0, 0.2), 1.0, kRounding)
                << name;
}

TEST(FilterTransform, IsBoundedByItsVariation) {
    for (const std::string& name : kAll) {
        const FilterProperties properties(makePrefilter(name, 2.0, {}));
        for (const double angle : {0.0, 0.1, kDiagonal})
            for (double f = 0.05; f < 6.0; f += 0.05)
                EXPECT_LE(std::abs(properties.transform(f, angle)) * 2 * M_PI * f,
                          properties.variation(angle) + kRounding * f * 8)
                    << name << ' ' << f;
    }
}

TEST(StepResponse, MeetsClosedForms) {
    const double R = 0.75;
    const FilterProperties box = propertiesOf("box", R), disk = propertiesOf("disk", R);
    std::mt19937 random(7);
    for (int i = 0; i < 1000; ++i) {
        const double t = std::uniform_real_distribution(-R, R)(random), q = t / R;
        EXPECT_NEAR(box.stepResponse(t, 0.0), 0.5 * (1 + q), kRounding);
        EXPECT_NEAR(disk.stepResponse(t, 1.1), 0.5 + (std::asin(q) + q * std::sqrt(1 - q * q)) / M_PI,
                    kRounding);
        const double rest = std::max(0.0, M_SQRT2 - std::abs(q));  // the corner beyond, along the diagonal
        const double corner = 0.25 * rest * rest;
        EXPECT_NEAR(box.stepResponse(t, kDiagonal), q > 0 ? 1 - corner : corner, kRounding);
    }
}

/// K(t) along the axis, and chords of radial kernels, which a ring form does not use.
TEST(StepResponse, MatchesQuadratureOfTheDefinitions) {
    for (const std::string& name : kAll) {
        const Prefilter filter = makePrefilter(name, 2.0, {});
        const FilterProperties properties(filter);
        const test::KernelTruth truth(filter);
        for (const double t : {0.001, 0.25, 0.66, 1.0, 1.3, 1.99}) {
            test::Integral beyond;
            if (filter.radial()) {
                // chords of the line's other side: x from t to R, y over the chord
                const auto chord = [&](test::Real s) {
                    const test::Real x = t + (truth.R - t) * (1 - s * s),
                                     h = std::sqrt(truth.R * truth.R - x * x);
                    const auto along = [&](test::Real u) { return 2 * h * truth(std::hypot(x, h * u)); };
                    return 2 * s * (truth.R - t) * test::integrate(along, 0, 1, 4).value;
                };
                beyond = test::integrate(chord, 0, 1, 4);
                EXPECT_NEAR(properties.stepResponse(t, 0.4), double(1 - beyond.value),
                            kRounding + 4 * double(beyond.error))
                    << name << ' ' << t;
            } else {
                EXPECT_NEAR(properties.stepResponse(t, 0.0), double(truth.massBelow(t).value),
                            kRounding + double(truth.massBelow(t).error))
                    << name << ' ' << t;
            }
        }
    }
}

TEST(StepResponse, IsOddAroundOneHalfAndEndsAtTheReach) {
    for (const std::string& name : kAll) {
        const FilterProperties properties(makePrefilter(name, 2.0, {}));
        for (const double angle : {0.0, 0.35, kDiagonal, 2.0}) {
            EXPECT_EQ(properties.stepResponse(0.0, angle), 0.5);
            EXPECT_EQ(properties.stepResponse(properties.reach(angle), angle), 1.0);
            // the slope is at most half the variation
            EXPECT_NEAR(properties.stepResponse(1e-9, angle), 0.5,
                        0.5e-9 * properties.variation(angle) + kRounding)
                << name;
            EXPECT_NEAR(properties.stepResponse(0.999999 * properties.reach(angle), angle), 1.0,
                        0.5e-6 * properties.reach(angle) * properties.variation(angle) + kRounding)
                << name;
            EXPECT_NEAR(properties.stepResponse(-0.7, angle) + properties.stepResponse(0.7, angle), 1.0,
                        kRounding);
        }
    }
}

TEST(FilterNumbers, MeetClosedForms) {
    const double R = 2.0, root = 1e-12;  // what bisection leaves
    EXPECT_NEAR(propertiesOf("box", R).edgeWidth(0.0), 0.8 * 2 * R, root);
    EXPECT_NEAR(propertiesOf("tent", R).edgeWidth(0.0), 2 * R * (1 - std::sqrt(0.2)), root);
    EXPECT_NEAR(propertiesOf("box", R).halfResponse(0.0), 0.6033545644016138 / (2 * R), root);  // sinc = 1/2
    EXPECT_NEAR(propertiesOf("box", R).secondMoment(), R * R / 3, kRounding);
    EXPECT_NEAR(propertiesOf("tent", R).secondMoment(), R * R / 6, kRounding);
    EXPECT_NEAR(propertiesOf("disk", R).secondMoment(), R * R / 4, kRounding);
    EXPECT_NEAR(propertiesOf("cone", R).secondMoment(), 3 * R * R / 20, kRounding);
    EXPECT_NEAR(propertiesOf("poly:1,-3,3,-1", R).secondMoment(), R * R / 10, kRounding);
    EXPECT_NEAR(propertiesOf("bspline", R).secondMoment(), R * R / 12, kRounding);
    EXPECT_NEAR(propertiesOf("catmull-rom", R).secondMoment(), 0.0, kRounding);
    // Keys' kernel at R = 2: int of the lobe between 1 and 2 is -1/24, so the step overshoots by 1/24
    EXPECT_NEAR(propertiesOf("catmull-rom", R).overshoot(0.0), 1.0 / 24, kRounding);
    const double absolute = 1 + 4.0 / 24;
    EXPECT_NEAR(propertiesOf("catmull-rom", R).negativeArea(), 0.5 * (absolute * absolute - 1), kRounding);
    // 1 - 2 q^2 is negative beyond q^2 = 1/2, and its integral 0: a little more of the first coefficient
    EXPECT_GT(propertiesOf("poly:1.2,-2", R).negativeArea(), 0.0);
    for (const char* name : {"box", "disk", "tent", "cone", "gaussian", "bspline", "poly:1,-3,3,-1"}) {
        EXPECT_EQ(propertiesOf(name, R).overshoot(0.3), 0.0) << name;
        EXPECT_NEAR(propertiesOf(name, R).negativeArea(), 0.0, kRounding) << name;
    }
}

TEST(FilterNumbers, ScaleWithTheRadius) {
    for (const std::string& name : kAll) {
        if (name == "lanczos") continue;  // its lobes are a pixel wide at any radius
        const FilterProperties one(makePrefilter(name, 1.0, {})), three(makePrefilter(name, 3.0, {}));
        EXPECT_NEAR(three.edgeWidth(0.4), 3 * one.edgeWidth(0.4), 1e-11) << name;
        EXPECT_NEAR(3 * three.halfResponse(0.4), one.halfResponse(0.4), 1e-11) << name;
        EXPECT_NEAR(three.secondMoment(), 9 * one.secondMoment(), 9 * kRounding) << name;
    }
}

/// The squared distance of the blurred edge from the ideal one, over space and over frequencies:
///     int (S(t) - [t > 0])^2 dt = 1/(2 pi^2) int_0^inf (1 - W^)^2 / f^2 df
/// where beyond F the integrand is 1/f^2 within (2 |W^| + W^2)/f^2, |W^| <= V/(2 pi f).
TEST(EdgeEnergyTest, Parseval) {
    constexpr double kF = 24.0;
    for (const std::string& name : kAll)
        for (const double angle : {0.0, kDiagonal}) {
            const FilterProperties properties(makePrefilter(name, 2.0, {}));
            const auto space = test::integrate(
                [&](test::Real t) { return std::pow(1 - properties.stepResponse(double(t), angle), 2); }, 0,
                properties.reach(angle), 24);
            const auto frequency = test::integrate(
                [&](test::Real f) { return std::pow((1 - properties.transform(double(f), angle)) / f, 2); },
                0, kF, 32);
            const double V = properties.variation(angle),
                         tail = V / (M_PI * kF * kF) + V * V / (12 * M_PI * M_PI * kF * kF * kF);
            EXPECT_NEAR(2 * double(space.value), (double(frequency.value) + 1 / kF) / (2 * M_PI * M_PI),
                        tail / (2 * M_PI * M_PI) + 4 * double(space.error + frequency.error) + kRounding)
                << name;
        }
}

TEST(EdgeEnergyTest, OfABoxMeetsItsSeries) {
    // 1/(2 pi^2) int_N^inf sinc^2(f)/f^2 df at R = 1/2, N = 1/2, by its own quadrature; to kEdgeBand
    const auto truth = test::integrate(
        [](test::Real f) {
            return std::pow(std::sin(test::Real(M_PIl) * f) / (test::Real(M_PIl) * f * f), 2);
        },
        0.5, kEdgeBand, 32);
    const EdgeEnergy energy = edgeEnergy(propertiesOf("box", 0.5), 0.0);
    EXPECT_NEAR(energy.aliasing, double(truth.value / (2 * M_PIl * M_PIl)), kRounding + double(truth.error));
    EXPECT_NEAR(energy.share, energy.aliasing * M_PI * M_PI, kRounding);
}

TEST(EdgeEnergyTest, MeanOverOrientationsLiesBetweenThem) {
    const FilterProperties box = propertiesOf("box", 1.0);
    const double axis = edgeEnergy(box, 0.0).blur, diagonal = edgeEnergy(box, kDiagonal).blur;
    const double mean = meanEdgeEnergy(box).blur;
    EXPECT_GT(mean, std::min(axis, diagonal));
    EXPECT_LT(mean, std::max(axis, diagonal));
}

}  // namespace
}  // namespace edgewise
