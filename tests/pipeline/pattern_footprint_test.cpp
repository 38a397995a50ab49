// Patterns over pixels, beside counts of points.
#include "pipeline/methods/pattern_footprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>

namespace edgewise {
namespace {

constexpr unsigned kSeed = 411;
constexpr int kSide = 256;

sdf::SurfaceMaterial material(sdf::SurfaceMaterial::Pattern pattern) {
    sdf::SurfaceMaterial made;
    made.pattern = pattern;
    made.color = {0.0, 0.0, 0.0}, made.second_color = {1.0, 1.0, 1.0};
    made.pattern_size = 0.5, made.pattern_axis = {0.6, 0.0, 0.8};
    return made;
}

double counted(const sdf::SurfaceMaterial& of, const glm::dvec3& p, const glm::dvec3& right,
               const glm::dvec3& down) {
    int second = 0;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i)
            second += sdf::showsSecondColor(
                of, p + ((i + 0.5) / kSide - 0.5) * right + ((j + 0.5) / kSide - 0.5) * down);
    return second / static_cast<double>(kSide * kSide);
}

class PatternFootprint : public testing::TestWithParam<sdf::SurfaceMaterial::Pattern> {};

/// Footprints of a quarter to 4 fields' sizes, near square and long, some seen by more borders than are told
/// apart exactly. The count is off by a point where a border leaves a row: by 1 / kSide a border at most.
TEST_P(PatternFootprint, IsTheMeanOfCountedPoints) {
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<> u(-1.0, 1.0);
    const sdf::SurfaceMaterial of = material(GetParam());
    double worst = 0.0, sum = 0.0;
    int mixed = 0;
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 p(4.0 * u(random), 0.01, 4.0 * u(random));
        const double size = 0.5 * std::exp2(-2.0 + 2.0 * u(random));
        const glm::dvec3 right = size * glm::normalize(glm::dvec3(u(random), 0.0, u(random)));
        const glm::dvec3 down = size * std::exp2(1.0 + u(random)) *
                                glm::normalize(glm::dvec3(-right.z, 0.0, right.x) + 0.5 * right * u(random));
        sdf::SurfaceHit hit;
        hit.hit = true, hit.p_local = p;
        const double wanted = counted(of, p, right, down);
        const auto color = patternOver(of, hit, right, down);
        if (!color) {
            // Less than a quarter of a field, with one colour in all corners: no border, or a corner of one
            // across less than that.
            EXPECT_NEAR(wanted, sdf::showsSecondColor(of, p) ? 1.0 : 0.0, 0.5);
            continue;
        }
        mixed += wanted > 0.05 && wanted < 0.95;
        worst = std::max(worst, std::abs(color->x - wanted)), sum += std::abs(color->x - wanted);
        EXPECT_LE(std::abs(color->x - wanted), 4.0 / kSide) << "seed " << kSeed << ", " << i;
    }
    std::printf("%d footprints show both colours; off by %.4f in the mean, %.4f at most\n", mixed, sum / 400,
                worst);
    EXPECT_GT(mixed, 150);
}

INSTANTIATE_TEST_SUITE_P(All, PatternFootprint,
                         testing::Values(sdf::SurfaceMaterial::Pattern::kChecker,
                                         sdf::SurfaceMaterial::Pattern::kStripes),
                         [](const auto& of) {
                             return of.param == sdf::SurfaceMaterial::Pattern::kChecker ? "Checker"
                                                                                        : "Stripes";
                         });

/// Far more fields than lines can tell apart.
TEST(PatternFootprintFar, IsHalfOfEach) {
    sdf::SurfaceHit hit;
    hit.hit = true, hit.p_local = {0.1, 0.01, 0.2};
    const auto color = patternOver(material(sdf::SurfaceMaterial::Pattern::kChecker), hit, {70.3, 0.0, 0.0},
                                   {1.0, 0.0, 300.7});
    ASSERT_TRUE(color);
    EXPECT_NEAR(color->x, 0.5, 1.0 / 128);
}

}  // namespace
}  // namespace edgewise
