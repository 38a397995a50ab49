// Rays of drawings against closed forms, and against the tracer that makes pictures.
#include "paper_figures/field_slice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sdf/sphere_trace.h"

namespace edgewise::figures {
namespace {

TEST(FieldSlice, ClassicStepsAreTheBallsDistances) {
    const sdf::Tape field = ballsField({{{3.0, 0.5}, 1.0}});
    SliceRay ray;
    const March march = marchAlong(field, ray, sdf::Relaxation::kNone, 1.0, 100);
    ASSERT_TRUE(march.hit);
    double t = ray.t_min;
    for (const MarchStep& step : march.steps) {
        EXPECT_NEAR(step.t, t, 64 * 0x1p-52);
        EXPECT_NEAR(step.radius, std::hypot(3.0 - t, 0.5) - 1.0, 64 * 0x1p-52);
        EXPECT_FALSE(step.relaxed || step.failed);
        t = step.t + step.radius;
    }
    // It ends within half a pixel, before the surface.
    const double surface = 3.0 - std::sqrt(0.75);
    EXPECT_LT(march.t, surface);
    EXPECT_LT(march.steps.back().radius, ray.pixel_slope * march.t);
}

TEST(FieldSlice, CountsAreTheTracersEvaluations) {
    constexpr unsigned kSeed = 20141;
    SCOPED_TRACE(testing::Message() << "seed " << kSeed);
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<double> x(1.5, 9.0), y(-2.0, 2.0), radius(0.3, 1.0);
    int relaxed = 0, failed = 0, hits = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const sdf::Tape field =
            ballsField({{{x(random), y(random)}, radius(random)}, {{x(random), y(random)}, radius(random)}});
        const SliceRay ray;
        if (valueOn(field, ray.origin) <= 0.0) continue;
        const March march = marchAlong(field, ray, sdf::Relaxation::kKeinert, 1.6, 500);
        sdf::TraceSettings settings;
        settings.relaxation = sdf::Relaxation::kKeinert, settings.omega = 1.6, settings.threshold = 1.0;
        settings.most_steps = 500;
        const sdf::TraceHit hit = sdf::traceRay(field,
                                                {glm::dvec3(ray.origin, 0.0), glm::dvec3(ray.direction, 0.0),
                                                 ray.t_min, ray.t_max, 0.0, ray.pixel_slope},
                                                settings);
        EXPECT_EQ(march.hit, hit.hit()) << trial;
        EXPECT_EQ(march.steps.size(), hit.evaluations) << trial;
        std::uint32_t taken_back = 0;
        for (const MarchStep& step : march.steps) relaxed += step.relaxed, taken_back += step.failed;
        EXPECT_EQ(taken_back, hit.failed) << trial;
        failed += taken_back > 0, hits += march.hit;
    }
    EXPECT_GT(relaxed, 500);
    EXPECT_GT(failed, 10);
    EXPECT_GT(hits, 50);
}

}  // namespace
}  // namespace edgewise::figures
