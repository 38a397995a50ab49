#include "sdf/cone_trace.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <random>

namespace edgewise::sdf {
namespace {

constexpr unsigned kSeed = 20231;

/// Down -z from z = 10, a pixel of half side 1 / sqrt(2): the cone's radius is 1 everywhere.
FieldRay rayAt(double x, double y) {
    FieldRay ray;
    ray.origin_world = {x, y, 10.0}, ray.direction_world = {0.0, 0.0, -1.0};
    ray.t_max = 40.0, ray.pixel_radius = std::sqrt(0.5);
    return ray;
}

ConeHits traced(const std::function<double(glm::dvec3)>& field, const FieldRay& ray,
                const ConeSettings& settings) {
    ConeTrace trace(ray, {}, settings);
    while (trace.asks()) trace.take(field(ray.origin_world + ray.direction_world * trace.askedAt()));
    return trace.hits();
}

/// A wall of half-space x <= edge, from z = -2 to z = 0.
double wall(const glm::dvec3& p, double edge) {
    const double x = p.x - edge, z = std::abs(p.z + 1.0) - 1.0;
    return std::hypot(std::max(x, 0.0), std::max(z, 0.0)) + std::min(std::max(x, z), 0.0);
}

std::uint32_t maskOf(const ConeGroup& group, const glm::dvec3& normal, const ConeSettings& settings) {
    return groupMask(group, normal, {1, 0, 0}, {0, -1, 0}, settings);
}

/// Of a disk of radius 1, the part on the far side of a line at distance d from its middle.
double diskShare(double d) {
    if (d >= 1.0) return 0.0;
    if (d <= -1.0) return 1.0;
    return (std::acos(d) - d * std::sqrt(1.0 - d * d)) / std::acos(-1.0);
}

TEST(ConeTrace, AMaskIsThePointsBelowItsLine) {
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<> number(-1.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(number(random), number(random), 0.3));
        const ConeGroup group{0.0, 0.0, number(random), false};
        const glm::dvec2 across = glm::normalize(glm::dvec2(normal.x, -normal.y));
        for (const bool four_by_eight : {false, true}) {
            ConeSettings settings;
            settings.four_by_eight = four_by_eight;
            const int columns = four_by_eight ? 8 : 6, rows = four_by_eight ? 4 : 6;
            int below = 0;
            for (int k = 0; k < rows * columns; ++k) {
                const int row = k / columns, column = k % columns;
                if (!four_by_eight && row % 5 == 0 && column % 5 == 0) continue;
                const glm::dvec2 p((column + 0.5) * 2 / columns - 1, (row + 0.5) * 2 / rows - 1);
                below += glm::dot(across, p) + group.least < 0.0;
            }
            EXPECT_EQ(std::popcount(maskOf(group, normal, settings)), below);
        }
    }
}

TEST(ConeTrace, AStraightEdgeCoversItsPartOfTheCone) {
    double worst = 0.0;
    int hard = 0, soft = 0;
    for (double edge = -1.2; edge <= 1.2; edge += 0.01) {
        const ConeSettings settings;
        const ConeHits hits = traced([&](glm::dvec3 p) { return wall(p, edge); }, rayAt(0.0, 0.0), settings);
        double share = 0.0;
        if (hits.count > 0) {
            ASSERT_EQ(hits.count, 1) << edge;
            (hits.groups[0].hard ? hard : soft) += 1;
            share = hits.full ? 1.0 : std::popcount(maskOf(hits.groups[0], {1, 0, 0}, settings)) / 32.0;
            EXPECT_EQ(hits.groups[0].hard, edge > -TraceSettings{}.threshold * std::sqrt(0.5)) << edge;
        }
        worst = std::max(worst, std::abs(share - diskShare(-edge)));
    }
    std::printf("%d hard, %d soft, share off by at most %.3f\n", hard, soft, worst);
    EXPECT_GT(soft, 50);
    EXPECT_GT(hard, 50);
    EXPECT_LE(worst, 0.5 * 6.0 / 32.0 +
                         1.0 / 32.0);  // half a column of the mask, and the points' uneven share of a disk
}

TEST(ConeTrace, GroupsAreInOrderAndTheirBitsDisjoint) {
    // A near wall on the left, a far one on the right: together they hide the sky but for their mask's
    // rounding.
    const auto field = [](glm::dvec3 p) {
        return std::min(wall(p, 0.0), wall(glm::dvec3(-p.x, p.y, p.z + 10.0), 0.0));
    };
    const ConeSettings settings;
    const ConeHits hits = traced(field, rayAt(0.02, 0.0), settings);
    ASSERT_EQ(hits.count, 2);
    EXPECT_LT(hits.groups[0].t, hits.groups[1].t);
    ConeBlend blend(settings);
    const glm::dvec3 normals[]{{1, 0, 0}, {-1, 0, 0}};
    const glm::dvec4 colors[]{{1, 0, 0, 1}, {0, 1, 0, 1}};
    for (int i = 0; i < 2; ++i)
        blend.add(blend.uncovered(maskOf(hits.groups[i], normals[i], settings)), colors[i]);
    const glm::dvec4 color = blend.over({0, 0, 1, 0});
    EXPECT_NEAR(color.x, 0.5, 0.1);
    EXPECT_NEAR(color.x + color.y + color.z, 1.0, 1e-15);
    EXPECT_EQ(color.z, 0.0);
}

TEST(ConeTrace, ARayThatMeetsNothingIsSky) {
    const ConeSettings settings;
    const ConeHits hits = traced([](glm::dvec3) { return 5.0; }, rayAt(0, 0), settings);
    EXPECT_EQ(hits.count, 0);
    EXPECT_EQ(ConeBlend(settings).over({0.1, 0.2, 0.3, 0.0}), glm::dvec4(0.1, 0.2, 0.3, 0.0));
}

TEST(ConeTrace, AFrontalWallIsWhole) {
    const ConeSettings settings;
    const ConeHits hits = traced([](glm::dvec3 p) { return p.z; }, rayAt(0, 0), settings);
    ASSERT_EQ(hits.count, 1);
    EXPECT_TRUE(hits.full && hits.groups[0].hard);
    EXPECT_EQ(maskOf(hits.groups[0], {0, 0, 1}, settings), ~0u);
    EXPECT_NEAR(hits.groups[0].t, 10.0, 0.125 * std::sqrt(0.5));
}

TEST(ConeTrace, RelaxedEndsAtTheFirstHardHit) {
    ConeSettings settings;
    settings.relaxed = true;
    const ConeHits hits = traced([](glm::dvec3 p) { return wall(p, 0.3); }, rayAt(0, 0), settings);
    ASSERT_EQ(hits.count, 1);
    EXPECT_TRUE(hits.full);
    EXPECT_EQ(maskOf(hits.groups[0], {1, 0, 0}, settings), ~0u);
}

TEST(ConeTrace, BacktracingIsNoLaterThanTheHit) {
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<> number(-1.0, 1.0);
    double off_with = 0.0, off_without = 0.0;
    for (int i = 0; i < 500; ++i) {
        // A slanted plane in front of the eye, met by the ray at t.
        const glm::dvec3 normal =
            glm::normalize(glm::dvec3(number(random), number(random), 1.0 + number(random)));
        if (normal.z < 0.2) continue;
        const auto field = [&](glm::dvec3 p) { return glm::dot(p, normal); };
        const FieldRay ray = rayAt(0, 0);
        ConeSettings settings;
        const double with = traced(field, ray, settings).groups[0].t;
        settings.backtrace = false;
        const double without = traced(field, ray, settings).groups[0].t;
        EXPECT_LE(with, 10.0 + 1e-12);
        off_with = std::max(off_with, std::abs(with - 10.0)),
        off_without = std::max(off_without, std::abs(without - 10.0));
    }
    std::printf("off by %.3f with backtracing, %.3f without\n", off_with, off_without);
    EXPECT_LT(off_with, 1.0);
}

}  // namespace
}  // namespace edgewise::sdf
