// The drawn cone against the one that makes pictures.
#include "paper_figures/cone_slice.h"

#include <gtest/gtest.h>

#include <random>

namespace edgewise::figures {
namespace {

TEST(ConeSlice, GroupsAreTheTracers) {
    constexpr unsigned kSeed = 20231;
    SCOPED_TRACE(testing::Message() << "seed " << kSeed);
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<double> x(2.0, 9.0), y(-1.2, 1.2), radius(0.1, 0.9);
    int soft = 0, hard = 0, several = 0, full = 0;
    for (int trial = 0; trial < 500; ++trial) {
        const sdf::Tape field =
            ballsField({{{x(random), y(random)}, radius(random)}, {{x(random), y(random)}, radius(random)}});
        const SliceRay ray{{0.0, 0.0}, {1.0, 0.0}, 0.2, 20.0, 0.05, 1.0};
        const ConeMarch march = marchCone(field, ray, {});
        sdf::TraceSettings settings;
        settings.relaxation = sdf::Relaxation::kNone;
        sdf::ConeTrace trace({glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 0.0), 0.2, 20.0, 0.0, 0.05}, settings,
                             {});
        while (trace.asks()) trace.take(valueOn(field, ray.at(trace.askedAt())));
        ASSERT_EQ(march.steps.size(), trace.hits().evaluations) << trial;
        ASSERT_EQ(march.groups.size(), std::size_t(trace.hits().count)) << trial;
        EXPECT_EQ(march.full, trace.hits().full) << trial;
        for (std::size_t i = 0; i < march.groups.size(); ++i) {
            const sdf::ConeGroup &drawn = march.groups[i].group, &traced = trace.hits().groups[i];
            EXPECT_EQ(drawn.t, traced.t);
            EXPECT_EQ(drawn.entry, traced.entry);
            EXPECT_EQ(drawn.least, traced.least);
            EXPECT_EQ(drawn.hard, traced.hard);
            EXPECT_LE(drawn.entry, march.groups[i].exit);
            // Nothing of the surface is in the cone's base at the entry.
            EXPECT_GE(valueOn(field, ray.at(drawn.entry)), 0.0) << trial;
            soft += !drawn.hard, hard += drawn.hard;
        }
        several += march.groups.size() > 1, full += march.full;
    }
    EXPECT_GT(soft, 50);
    EXPECT_GT(hard, 50);
    EXPECT_GT(several, 20);
    EXPECT_GT(full, 50);
}

}  // namespace
}  // namespace edgewise::figures
