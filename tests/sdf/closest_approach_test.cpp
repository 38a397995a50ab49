// Where rays pass solids nearest, against closed forms and a search along the ray.
#include "sdf/closest_approach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "sdf/evaluate.h"
#include "sdf/tree.h"

namespace edgewise::sdf {
namespace {

constexpr unsigned kSeed = 20235;
/// Of a pixel's radius: how much nearer the ray may come elsewhere.
constexpr double kSettled = 1.0 / 64.0;

FieldRay rayPast(std::mt19937& random, double distance) {
    std::uniform_real_distribution<> number(-1.0, 1.0);
    FieldRay ray;
    const auto vector = [&] { return glm::dvec3(number(random), number(random), number(random)); };
    ray.direction_world = glm::normalize(vector());
    const glm::dvec3 aside = glm::normalize(glm::cross(ray.direction_world, vector()));
    ray.origin_world = distance * aside - 5.0 * ray.direction_world;
    ray.pixel_radius = 0.01;
    return ray;
}

/// Beside the foot of the middle a ball's distance grows as the hypotenuse does.
TEST(ClosestApproach, ABallIsItsClosedForm) {
    Tree tree;
    tree.add(Kind::kSphere, {1.0});
    const Tape tape = lower(tree);
    const CellTapes cells(tape, glm::dvec3(0.0), 8.0, false);
    std::mt19937 random(kSeed);
    std::printf("seed %u\n", kSeed);
    std::uniform_real_distribution<> off(-0.2, 0.2);
    for (const double gap : {0.0001, 0.002, 0.01, 0.1, 1.0}) {
        int settled = 0;
        double worst = 0.0;
        for (int i = 0; i < 200; ++i) {
            const double middle = 1.0 + gap;
            FieldRay ray = rayPast(random, middle);
            // Where the ray is within the ball's hull already, it has no room to miss it.
            const double reach = 0.9 * std::sqrt(middle * middle - 1.0);
            const auto near = closestApproach(cells, ray, 5.0 + std::clamp(off(random), -reach, reach));
            if (!near) continue;
            ++settled;
            const double longer = kSettled * ray.pixel_radius;
            EXPECT_LE(near->distance, gap + longer);
            EXPECT_GE(near->distance, gap - 1e-12);
            EXPECT_LE(std::abs(near->t - 5.0), std::sqrt((2.0 * middle + longer) * longer) + 1e-9);
            EXPECT_NEAR(glm::length(near->surface_world), 1.0, 1e-12);
            EXPECT_NEAR(glm::length(near->outwards_world), 1.0, 1e-12);
            worst = std::max(worst, (near->distance - gap) / ray.pixel_radius);
        }
        std::printf(
            "passing a ball of radius 1 at %.4f: %d of 200 settle, distances too long by at most %.4f pixel "
            "radii\n",
            gap, settled, worst);
        EXPECT_EQ(settled, 200) << gap;
    }
}

/// f along the ray is searched on a fine lattice, then by thirds.
double leastAlong(const Tape& tape, const FieldRay& ray, double from, double to) {
    const auto value = [&](double t) { return valueAt(tape, ray.origin_world + t * ray.direction_world); };
    double best = from;
    for (double t = from; t <= to; t += 0.002)
        if (value(t) < value(best)) best = t;
    double low = best - 0.002, high = best + 0.002;
    while (high - low > 1e-9) {
        const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
        (value(a) < value(b) ? high : low) = value(a) < value(b) ? b : a;
    }
    return 0.5 * (low + high);
}

TEST(ClosestApproach, BoxesAndTheirEdgesAreTheSearchs) {
    Tree tree;
    tree.add(Kind::kBox, {2.0, 1.0, 1.5});
    const Tape tape = lower(tree);
    const CellTapes cells(tape, glm::dvec3(0.0), 8.0, false);
    std::mt19937 random(kSeed);
    std::printf("seed %u\n", kSeed);
    int met = 0, none = 0;
    double worst = 0.0;
    while (met + none < 300) {
        std::uniform_real_distribution<> aside(0.6, 1.5);
        const FieldRay ray = rayPast(random, aside(random));
        const double t = leastAlong(tape, ray, 3.0, 7.0);
        const double distance = valueAt(tape, ray.origin_world + t * ray.direction_world);
        if (distance <= 0.002 || distance > 0.02) continue;  // up to two radii of the pixel
        std::uniform_real_distribution<> off(-0.02, 0.02);
        const auto near = closestApproach(cells, ray, t + off(random));
        if (!near) {
            ++none;
            continue;
        }
        ++met;
        worst = std::max(worst, (near->distance - distance) / ray.pixel_radius);
        EXPECT_GE(near->distance, distance - 1e-9);
        // The plane that outlines are made of turns with it.
        EXPECT_LE(std::abs(glm::dot(near->outwards_world, ray.direction_world)), 1.0 / 32.0);
        // Settled or not, the point is of the surface, and leads out to the ray's point at its distance.
        EXPECT_NEAR(valueAt(tape, near->surface_world), 0.0, 1e-12);
        const glm::dvec3 back = near->surface_world + near->distance * near->outwards_world;
        EXPECT_LE(glm::distance(back, ray.origin_world + near->t * ray.direction_world), 1e-12);
    }
    std::printf("%d found, %d not; distances too long by at most %.4f radii of the pixel\n", met, none,
                worst);
    EXPECT_GT(met, 280);
    EXPECT_LE(worst, kSettled);
}

/// Of the line through a point of the ray, at t = 0, and the line where planes n x = a and m x = b meet.
struct LinesApart {
    double t, distance;
    LinesApart(const glm::dvec3& d, const glm::dvec3& n, double a, const glm::dvec3& m, double b) {
        const glm::dvec3 e = glm::normalize(glm::cross(n, m));
        const double c = glm::dot(n, m), own = (a - b * c) / (1.0 - c * c),
                     other = (b - a * c) / (1.0 - c * c);
        const glm::dvec3 p = own * n + other * m, off = p - e * glm::dot(p, e), flat = d - e * glm::dot(d, e);
        t = glm::dot(off, flat) / glm::dot(flat, flat);
        distance = glm::distance(t * flat, off);
    }
};

/// The greater one of two planes' distances, one of them with values shrunk, has no gradient that leads from
/// its edge to the ray.
TEST(ClosestApproach, TheEdgeOfTwoFacesIsPassedWhereItLies) {
    std::mt19937 random(kSeed);
    std::printf("seed %u\n", kSeed);
    std::uniform_real_distribution<> number(-1.0, 1.0), radii(0.1, 2.0), factor(0.2, 1.0), off(-0.02, 0.02);
    const auto unit = [&] {
        return glm::normalize(glm::dvec3(number(random), number(random), number(random)));
    };
    // Some twenty roundings of places of 5, over the sines of the angles above: 0.1 at the ray, 0.3 between
    // planes.
    constexpr double kRounding = 20.0 * 5.0 * 0x1p-53 / (0.1 * 0.3);
    int met = 0;
    double worst = 0.0, worst_t = 0.0, worst_turn = 0.0;
    while (met < 300) {
        const glm::dvec3 d = unit(), n = unit(), m = unit();
        // The ray comes nearer to the one face and leaves the other, both beyond what could be rounding;
        // their edge sticks out, and is seen at an angle.
        if (glm::dot(d, n) > -0.1 || glm::dot(d, m) < 0.1 || std::abs(glm::dot(n, m)) > 0.95) continue;
        if (glm::length(glm::cross(d, glm::normalize(glm::cross(n, m)))) < 0.1) continue;
        FieldRay ray;
        ray.direction_world = d, ray.origin_world = glm::dvec3(0.0), ray.pixel_radius = 0.01,
        ray.pixel_slope = 0.0;
        // Both faces below the ray's point at t = 5, by as much.
        const double height = radii(random) * ray.pixel_radius, shrink = factor(random);
        const double a = 5.0 * glm::dot(n, d) - height, b = 5.0 * glm::dot(m, d) - height / shrink;
        Tree tree;
        const auto first = tree.add(Kind::kPlane, {n.x, n.y, n.z, a});
        const auto second =
            tree.add(Kind::kScaleValue, {shrink}, {tree.add(Kind::kPlane, {m.x, m.y, m.z, b})});
        tree.root = tree.add(Kind::kIntersection, {}, {first, second});
        const Tape tape = lower(tree);
        const CellTapes cells(tape, glm::dvec3(0.0), 8.0, false);
        const auto near = closestApproach(cells, ray, 5.0 + off(random));
        ASSERT_TRUE(near);
        ++met;
        const LinesApart exact(d, n, a, m, b);
        worst = std::max(worst, std::abs(near->distance - exact.distance));
        worst_t = std::max(worst_t, std::abs(near->t - exact.t));
        worst_turn = std::max(worst_turn, std::abs(glm::dot(near->outwards_world, d)));
        EXPECT_NEAR(valueAt(tape, near->surface_world), 0.0, kRounding);
    }
    std::printf("%d edges off by at most %.1e, along the ray %.1e, %.1e of the right angle (bound %.1e)\n",
                met, worst, worst_t, worst_turn, kRounding);
    EXPECT_LE(worst, kRounding);
    EXPECT_LE(worst_t, kRounding / 0.1);
    EXPECT_LE(worst_turn, kRounding);
}

TEST(ClosestApproach, NoneWithinTheSolidOrBesideAWall) {
    Tree tree;
    tree.add(Kind::kBox, {2.0, 2.0, 2.0});
    const Tape tape = lower(tree);
    const CellTapes cells(tape, glm::dvec3(0.0), 8.0, false);
    FieldRay ray;
    ray.direction_world = {0.0, 0.0, -1.0}, ray.origin_world = {0.3, 0.2, 5.0}, ray.pixel_radius = 0.01;
    EXPECT_FALSE(closestApproach(cells, ray, 5.0));
    ray.origin_world.x = 1.25;
    const auto beside = closestApproach(cells, ray, 5.5);
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->distance, 0.25);
    EXPECT_EQ(beside->outwards_world, glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(beside->surface_world, glm::dvec3(1.0, 0.2, -0.5));
}

}  // namespace
}  // namespace edgewise::sdf
