#include "sdf/sphere_trace.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "sdf/evaluate.h"
#include "trace_scenes.h"

namespace edgewise::sdf {
namespace {

constexpr std::array<Relaxation, 4> kAll{Relaxation::kNone, Relaxation::kKeinert, Relaxation::kBalint,
                                         Relaxation::kAuto};

TraceSettings settingsOf(Relaxation relaxation) {
    TraceSettings settings;
    settings.relaxation = relaxation;
    settings.omega = relaxation == Relaxation::kKeinert ? 1.6 : 1.2;
    settings.most_steps = 100000;
    return settings;
}

/// A ray in free space with a threshold of `tolerance` everywhere.
FieldRay plainRay(const glm::dvec3& from, const glm::dvec3& to, double tolerance,
                  const TraceSettings& settings) {
    FieldRay ray;
    ray.origin_world = from;
    ray.direction_world = glm::normalize(to - from);
    ray.t_max = 30.0;
    ray.pixel_radius = tolerance / settings.threshold;
    return ray;
}

using Random = std::mt19937_64;
glm::dvec3 pointIn(Random& random, double half) {
    std::uniform_real_distribution<double> at(-half, half);
    const double x = at(random), y = at(random);
    return {x, y, at(random)};
}

std::optional<double> meetSphere(const FieldRay& ray, double radius) {
    const double b = glm::dot(ray.origin_world, ray.direction_world);
    const double c = glm::dot(ray.origin_world, ray.origin_world) - radius * radius;
    if (b * b < c) return std::nullopt;
    const double t = -b - std::sqrt(b * b - c);
    return t > 0.0 ? std::optional(t) : std::nullopt;
}

std::optional<double> meetBox(const FieldRay& ray, double half) {
    double first = -1e30, last = 1e30;
    for (int i = 0; i < 3; ++i) {
        const double a = (-half - ray.origin_world[i]) / ray.direction_world[i],
                     b = (half - ray.origin_world[i]) / ray.direction_world[i];
        first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
    }
    return first < last && first > 0.0 ? std::optional(first) : std::nullopt;
}

/// (|p|^2 + R^2 - r^2)^2 - 4 R^2 (x^2 + z^2), whose sign changes are bracketed on a fine grid.
std::optional<double> meetTorus(const FieldRay& ray, double major, double minor) {
    const auto quartic = [&](double t) {
        const glm::dvec3 p = ray.origin_world + ray.direction_world * t;
        const double k = glm::dot(p, p) + major * major - minor * minor;
        return k * k - 4.0 * major * major * (p.x * p.x + p.z * p.z);
    };
    constexpr int kCells = 8192;
    double before = 0.0;
    for (int i = 1; i <= kCells; ++i) {
        double after = 16.0 * i / kCells;
        if (quartic(after) <= 0.0) {
            for (int j = 0; j < 60; ++j) {
                const double middle = 0.5 * (before + after);
                (quartic(middle) > 0.0 ? before : after) = middle;
            }
            return after;
        }
        before = after;
    }
    return std::nullopt;
}

/// Hits lie in front of the closed form's by what the threshold allows: the ray is within `tolerance` of the
/// surface there, and has passed none. Misses pass the surface, but for rays that graze it within the
/// tolerance.
template <class Meet>
void expectHits(const Tree& tree, const Meet& meet, const char* what) {
    const Tape tape = lower(tree);
    constexpr double kTolerance = 1e-6;
    constexpr unsigned kSeed = 20260;
    for (const Relaxation relaxation : kAll) {
        Random random(kSeed);
        const TraceSettings settings = settingsOf(relaxation);
        int hits = 0, misses = 0, grazing = 0;
        for (int i = 0; i < 3000; ++i) {
            const glm::dvec3 from = 5.0 * glm::normalize(pointIn(random, 1.0));
            const FieldRay ray = plainRay(from, pointIn(random, 1.2), kTolerance, settings);
            const std::optional<double> truth = meet(ray);
            const TraceHit hit = traceRay(tape, ray, settings);
            if (hit.hit()) {
                ++hits;
                EXPECT_LE(valueAt(tape, ray.origin_world + ray.direction_world * hit.t), kTolerance);
            }
            if (truth) {
                EXPECT_TRUE(hit.hit()) << what << " ray " << i << " seed " << kSeed;
                EXPECT_LE(hit.t, *truth + kTolerance) << what << " ray " << i;
            }
            if (!truth && hit.hit()) ++grazing;
            misses += !truth;
        }
        EXPECT_GT(hits, 500);
        EXPECT_GT(misses, 200);
        EXPECT_LT(grazing, 10);
    }
}

TEST(SphereTrace, SpheresAreMetWhereTheQuadraticSays) {
    Tree tree;
    tree.add(Kind::kSphere, {0.8});
    expectHits(
        tree, [](const FieldRay& ray) { return meetSphere(ray, 0.8); }, "sphere");
}

TEST(SphereTrace, BoxesAreMetWhereTheSlabsSay) {
    Tree tree;
    tree.add(Kind::kBox, {1.2, 1.2, 1.2});
    expectHits(
        tree, [](const FieldRay& ray) { return meetBox(ray, 0.6); }, "box");
}

TEST(SphereTrace, ToriAreMetWhereTheQuarticSays) {
    Tree tree;
    tree.add(Kind::kTorus, {0.8, 0.3});
    expectHits(
        tree, [](const FieldRay& ray) { return meetTorus(ray, 0.8, 0.3); }, "torus");
}

TEST(SphereTrace, RaysThatGrazeASphereByMoreThanTheToleranceMissIt) {
    Tree tree;
    tree.add(Kind::kSphere, {1.0});
    const Tape tape = lower(tree);
    for (const Relaxation relaxation : kAll)
        for (const double clearance : {1e-1, 1e-3, 1e-5, 2e-6, -2e-6, -1e-3}) {
            const TraceSettings settings = settingsOf(relaxation);
            const FieldRay ray = plainRay({-5, 1.0 + clearance, 0}, {5, 1.0 + clearance, 0}, 1e-6, settings);
            EXPECT_EQ(traceRay(tape, ray, settings).hit(), clearance < 0.0) << clearance;
        }
}

TEST(SphereTrace, APlaneIsMetFromBothSidesBySign) {
    Tree tree;
    tree.add(Kind::kPlane, {0, 1, 0, 0.25});
    const Tape tape = lower(tree);
    for (const Relaxation relaxation : kAll) {
        const TraceSettings settings = settingsOf(relaxation);
        const FieldRay down = plainRay({0, 3, 0}, {1, 0, 1}, 1e-7, settings),
                       up = plainRay({0, -2, 0}, {0.5, 1, 0}, 1e-7, settings);
        const TraceHit above = traceRay(tape, down, settings), below = traceRay(tape, up, settings, -1.0);
        ASSERT_TRUE(above.hit() && below.hit());
        // The threshold in height, along a ray that falls by |direction.y| a unit.
        EXPECT_NEAR(above.t, -2.75 / down.direction_world.y, 1e-7 / -down.direction_world.y);
        EXPECT_NEAR(below.t, 2.25 / up.direction_world.y, 1e-7 / up.direction_world.y);
        EXPECT_GE(above.value, 0.0);
        EXPECT_LE(below.value, 0.0);
    }
}

/// No relaxation passes a surface that classic steps meet: thin things in random places, many rays.
TEST(SphereTrace, NoRelaxationPassesASurface) {
    constexpr unsigned kSeed = 4711;
    Random random(kSeed);
    std::array<std::uint64_t, 4> failed{}, hits{};
    for (int scene = 0; scene < 40; ++scene) {
        Tree tree;
        std::vector<std::uint32_t> parts;
        for (int i = 0; i < 30; ++i) {
            const glm::dvec3 a = pointIn(random, 2.0), b = a + pointIn(random, 0.6);
            parts.push_back(i % 2 ? tree.add(Kind::kCapsule, {a.x, a.y, a.z, b.x, b.y, b.z, 0.004})
                                  : placed(tree, tree.add(Kind::kBox, {0.4, 0.003, 0.4}), a));
        }
        tree.add(Kind::kUnion, {}, parts);
        const Tape tape = lower(tree);
        for (int i = 0; i < 250; ++i) {
            const glm::dvec3 from = 5.0 * glm::normalize(pointIn(random, 1.0));
            const glm::dvec3 to = pointIn(random, 2.0);
            double classic = 0.0;
            for (const Relaxation relaxation : kAll) {
                const TraceSettings settings = settingsOf(relaxation);
                const FieldRay ray = plainRay(from, to, 1e-5, settings);
                const TraceHit hit = traceRay(tape, ray, settings);
                const auto which = static_cast<std::size_t>(relaxation);
                failed[which] += hit.failed, hits[which] += hit.hit();
                const double t = hit.hit() ? hit.t : ray.t_max;
                if (relaxation == Relaxation::kNone) classic = t;
                // Where both stop, the ray is within the threshold of the same surface: so far apart at a
                // grazing angle at most.
                EXPECT_NEAR(t, classic, 0.02) << "scene " << scene << " ray " << i << " seed " << kSeed;
            }
        }
    }
    EXPECT_EQ(failed[0], 0u);
    EXPECT_GT(hits[0], 500u);
    for (int i = 1; i < 4; ++i) {
        EXPECT_GT(failed[i], 1000u);
        EXPECT_EQ(hits[i], hits[0]);
    }
}

TEST(SphereTrace, RelaxationsAskLess) {
    std::array<double, 4> product{1, 1, 1, 1};
    int scenes = 0;
    for (const TraceScene& scene : traceScenes()) {
        const Tape tape = lower(scene.tree);
        std::array<double, 4> evaluations{}, failed{};
        for (const FieldRay& ray : pictureRays(scene, 64))
            for (const Relaxation relaxation : kAll) {
                TraceSettings settings;
                settings.relaxation = relaxation;
                const TraceHit hit = traceRay(tape, ray, settings);
                evaluations[static_cast<std::size_t>(relaxation)] += hit.evaluations;
                failed[static_cast<std::size_t>(relaxation)] += hit.failed;
            }
        std::printf(
            "%-12s classic %6.2f a ray; keinert 1.2 %.3f, balint %.3f (failed %.2f), auto %.3f (failed %.2f) "
            "fewer\n",
            scene.name.c_str(), evaluations[0] / 4096, evaluations[0] / evaluations[1],
            evaluations[0] / evaluations[2], failed[2] / 4096, evaluations[0] / evaluations[3],
            failed[3] / 4096);
        for (int i = 0; i < 4; ++i) product[i] *= evaluations[0] / evaluations[i];
        EXPECT_GE(evaluations[0], evaluations[3]) << scene.name;
        ++scenes;
    }
    const auto mean = [&](int i) { return std::pow(product[i], 1.0 / scenes); };
    std::printf("geometric mean: keinert %.3f, balint %.3f, auto %.3f\n", mean(1), mean(2), mean(3));
    EXPECT_GT(mean(1), 1.0);
    EXPECT_GT(mean(3), 1.25);
}

}  // namespace
}  // namespace edgewise::sdf
