// Longer steps of cones: do they pass anything that a cone meets, and are they worth it?
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "sdf/cone_step.h"

namespace edgewise::sdf::cones {
namespace {

constexpr unsigned kSeed = 20239;

/// Balls and thin slabs before and beside a ray along z; exact distances of the parts.
struct Field {
    struct Part {
        glm::dvec3 center, normal;
        double radius;
        bool slab;
    };
    std::vector<Part> parts;
    double at(double t) const {
        double value = 100.0;
        for (const Part& part : parts) {
            const glm::dvec3 p = glm::dvec3(0.0, 0.0, t) - part.center;
            value = std::min(value,
                             (part.slab ? std::abs(glm::dot(p, part.normal)) : glm::length(p)) - part.radius);
        }
        return value;
    }
    explicit Field(std::mt19937& random) {
        std::uniform_real_distribution<> u(-1.0, 1.0);
        for (int i = 0; i < 12; ++i) {
            const double z = 15.0 + 14.0 * u(random), far = 0.2 + 1.5 * std::abs(u(random));
            const bool slab = i % 6 == 5;
            parts.push_back({{far * u(random), far * u(random), z},
                             glm::normalize(glm::dvec3(u(random), u(random), 0.6 + u(random))),
                             slab ? 0.02 + 0.3 * std::abs(u(random)) : 0.02 + std::abs(u(random)),
                             slab});
        }
    }
};

ConeRules rulesOf(bool overstep) {
    return {.t_max = 30.0,
            .radius = 0.0,
            .slope = 0.01,
            .alpha = 0.5,
            .hard = 0.088,
            .relaxed = false,
            .backtrace = true,
            .overstep = overstep};
}

struct Walk {
    int evaluations = 0, groups = 0, longer = 0, taken_back = 0;
    bool full = false;
};

/// `passed(before, s)` of every longer step that is not taken back: the states on its way and after it.
template <class Passed>
Walk walk(const Field& field, const ConeRules& rules, const Passed& passed) {
    Walk result;
    ConeState s = coneFrom(rules, 0.5);
    while (!coneEnded(s) && result.evaluations < 5000) {
        const ConeState before = s;
        s = coneTake(rules, s, field.at(coneAt(s)));
        ++result.evaluations;
        result.groups += s.closed;
        if (s.last_t == before.t) {
            if (before.longer) ++result.longer, passed(before, s);
        } else {
            ++result.taken_back;
        }
    }
    result.full = s.end == kConeFull;
    return result;
}

TEST(ConeSteps, PassNoGroupAndLeaveNone) {
    std::mt19937 random(kSeed);
    Walk all;
    int in_groups = 0, before_hits = 0, landed = 0, flown_through = 0;
    for (int i = 0; i < 2000; ++i) {
        const Field field(random);
        const ConeRules rules = rulesOf(true);
        const Walk made = walk(field, rules, [&](const ConeState& before, const ConeState& after) {
            const double from = before.last_t, to = before.t;
            const bool open = before.open, lands = open && !before.hard && after.hard;
            in_groups += open, landed += lands;
            before_hits += open && !before.hard && !lands;
            bool within = false;
            for (int k = 1; k < 200; ++k) {
                const double t = from + (to - from) * k / 200.0, radius = coneRadiusAt(rules, t);
                // Of a cone, a share of slope^2 / 2 less than of a cylinder.
                const double slack = radius * rules.slope * rules.slope;
                if (open)
                    ASSERT_LT(field.at(t), radius) << "seed " << kSeed << ", field " << i;
                else
                    ASSERT_GT(field.at(t), radius - slack) << "seed " << kSeed << ", field " << i;
                // Two balls hold the ray up to where it meets the surface.
                const bool held = open && !before.hard && !lands;
                ASSERT_FALSE(held && field.at(t) < 0.0) << "seed " << kSeed << ", field " << i;
                within = within || field.at(t) < 0.0;
            }
            flown_through += lands && within;
        });
        all.longer += made.longer, all.taken_back += made.taken_back;
    }
    std::printf("%d longer steps, %d of them in groups; %d taken back\n", all.longer, in_groups,
                all.taken_back);
    EXPECT_GT(all.longer - in_groups, 2000);
    std::printf(
        "%d of them before the ray has met the surface; %d more to where it does, %d of these through "
        "a part of it\n",
        before_hits, landed, flown_through);
    EXPECT_GT(in_groups, 1000);
    EXPECT_GT(before_hits, 100);
    EXPECT_GT(landed, 100);
    EXPECT_EQ(flown_through, 0);
    EXPECT_GT(all.taken_back, 1000);
}

/// Groups that a least step may or may not step into are shorter than the radius: those alone may differ.
TEST(ConeSteps, MeetWhatAlgorithm1Meets) {
    std::mt19937 random(kSeed);
    const auto nothing = [](const ConeState&, const ConeState&) {};
    std::uint64_t plain_evaluations = 0, longer_evaluations = 0;
    int differ = 0, groups = 0;
    for (int i = 0; i < 2000; ++i) {
        const Field field(random);
        const Walk plain = walk(field, rulesOf(false), nothing), longer = walk(field, rulesOf(true), nothing);
        EXPECT_EQ(plain.longer, 0);
        plain_evaluations += plain.evaluations, longer_evaluations += longer.evaluations;
        differ += plain.groups != longer.groups || plain.full != longer.full;
        groups += plain.groups;
    }
    std::printf("%d groups; %d of 2000 rays differ; %.2f times fewer evaluations\n", groups, differ,
                static_cast<double>(plain_evaluations) / static_cast<double>(longer_evaluations));
    EXPECT_GT(groups, 2000);
    EXPECT_LE(differ, 2000 / 20);
    EXPECT_LT(longer_evaluations, plain_evaluations);
}

/// A step that rounds to more than the least one must not be taken for a longer one, again and again.
TEST(ConeSteps, EndInFloatFarFromTheEye) {
    ConeRules rules = rulesOf(true);
    rules.slope = 1e-4, rules.t_max = 1000.0;
    ConeState s = coneFrom(rules, 1.0);
    int evaluations = 0;
    for (; !coneEnded(s) && evaluations < 20000; ++evaluations) {
        s.t = static_cast<float>(s.t);
        s = coneTake(rules, s, static_cast<float>(0.9e-4 * 500.0 + std::max(0.0, s.t - 900.0)));
    }
    EXPECT_LT(evaluations, 20000);
}

}  // namespace
}  // namespace edgewise::sdf::cones
