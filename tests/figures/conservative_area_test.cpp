// What a triangle is gathered for, against distances sample by sample.
#include "paper_figures/conservative_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace edgewise::figures {
namespace {

double side(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

bool holds(const Corners& t, glm::dvec2 p) {
    const bool s0 = side(t[0], t[1], p) > 0, s1 = side(t[1], t[2], p) > 0, s2 = side(t[2], t[0], p) > 0;
    return s0 == s1 && s1 == s2;
}

double distance(const Corners& t, glm::dvec2 p) {
    if (holds(t, p)) return 0.0;
    double least = INFINITY;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec2 a = t[i], d = t[(i + 1) % 3] - a;
        const double at = std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
        least = std::min(least, glm::length(p - a - at * d));
    }
    return least;
}

TEST(ConservativeArea, CountsAreThoseOfDistances) {
    constexpr unsigned kSeed = 20131;
    SCOPED_TRACE(testing::Message() << "seed " << kSeed);
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<double> at(-6.0, 38.0), reach(0.3, 3.0);
    const PixelBox film{0, 0, 32, 32};
    int acute = 0, cut_by_box = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const Corners t{{{at(random), at(random)}, {at(random), at(random)}, {at(random), at(random)}}};
        const double h = reach(random);
        const Corners large = thickened(t, h);
        GatherCounts counts;
        for (int j = 0; j < 32; ++j)
            for (int i = 0; i < 32; ++i) {
                const glm::dvec2 p(i + 0.5, j + 0.5);
                const bool needed = distance(t, p) <= h, thick = holds(large, p);
                EXPECT_TRUE(thick || !needed) << "the paper's triangle misses a sample it needs";
                const auto beyond = [&](int axis) {
                    return p[axis] < std::min({t[0][axis], t[1][axis], t[2][axis]}) - h ||
                           p[axis] > std::max({t[0][axis], t[1][axis], t[2][axis]}) + h;
                };
                counts.needed += needed, counts.thickened += thick, counts.covered += holds(t, p);
                counts.clipped += thick && !beyond(0) && !beyond(1);
            }
        const GatherCounts found = gatherCounts(t, h, film);
        EXPECT_EQ(found.needed, counts.needed) << trial;
        EXPECT_EQ(found.thickened, counts.thickened) << trial;
        EXPECT_EQ(found.clipped, counts.clipped) << trial;
        EXPECT_EQ(found.covered, counts.covered) << trial;
        acute += incircleOf(t).radius < 0.5, cut_by_box += counts.clipped < counts.thickened;
    }
    EXPECT_GT(acute, 10);
    EXPECT_GT(cut_by_box, 50);
}

TEST(ConservativeArea, EdgesMoveOutwardsByH) {
    const Corners t{{{1, 2}, {9, 3}, {4, 11}}};
    const double h = 2.0;
    const Corners large = thickened(t, h);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec2 a = t[i], b = t[(i + 1) % 3];
        for (const glm::dvec2& p : {large[i], large[(i + 1) % 3]})
            EXPECT_NEAR(std::abs(side(a, b, p)) / glm::length(b - a), h, 64 * 0x1p-52);
    }
}

}  // namespace
}  // namespace edgewise::figures
