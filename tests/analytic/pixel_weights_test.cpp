#include "analytic/pixel_weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>

#include "analytic/edge_integral.h"
#include "tests/analytic/triangle_map.h"

namespace edgewise::test {
namespace {

constexpr std::uint32_t kSeed = 20130513;
const char* const kFilters[] = {"box", "disk", "tent", "cone", "gaussian", "gaussian-separable", "bspline", "mitchell",
                                "catmull-rom", "bc:0.2,0.4", "lanczos", "poly:1,-2,1"};

double onGrid(double x) { return std::round(x * 0x1p32) * 0x1p-32; }
glm::dvec2 onGrid(glm::dvec2 p) { return {onGrid(p.x), onGrid(p.y)}; }

/// A fan of `count` triangles around `hub`, closed at `reach`.
std::vector<MapTriangle> fanAround(glm::dvec2 hub, double reach, int count) {
    std::vector<MapTriangle> fan;
    const auto rim = [&](int i) {
        const double angle = 2 * M_PI * (i % count + 0.37) / count;
        return onGrid(hub + reach * glm::dvec2(std::cos(angle), std::sin(angle)));
    };
    for (int i = 0; i < count; ++i) fan.push_back({{hub, rim(i), rim(i + 1)}, static_cast<Owner>(i)});
    return fan;
}

std::vector<MapTriangle> squareAround(glm::dvec2 middle, double half) {
    const glm::dvec2 a = middle + glm::dvec2(-half, -half), b = middle + glm::dvec2(half, -half),
                     c = middle + glm::dvec2(half, half), d = middle + glm::dvec2(-half, half);
    return {{{a, b, c}, 0}, {{a, c, d}, 1}};
}

std::int64_t sum(const std::map<Owner, FixedWeight>& weights) {
    std::int64_t total = 0;
    for (const auto& [owner, weight] : weights) total += weight;
    return total;
}

/// The maps that the brief of a weight stage should fear, around the sample (3.5, 4.5).
std::vector<std::pair<std::string, std::vector<MapTriangle>>> hardMaps(double R) {
    const glm::dvec2 s{3.5, 4.5};
    return {
        {"triangle", {{{onGrid({1.2, 2.1}), onGrid({5.7, 3.9}), onGrid({2.3, 6.6})}, 7}}},
        {"square", squareAround(s, 64)},
        {"fan on the sample", fanAround(s, 40, 1000)},
        {"fan inside", fanAround(onGrid(s + 0.3 * R), 0.25 * R, 12)},
        {"vertex on the border", fanAround({s.x + R, s.y + R}, 0.75 * R, 7)},
        {"vertex on the axis", fanAround({s.x + R, s.y}, 0.75 * R, 7)},
        {"vertex on the left of the axis", fanAround({s.x - R, s.y}, 3 * R, 9)},
        {"edge through the sample", {{{glm::dvec2(s.x - 8, s.y - 8), glm::dvec2(s.x + 8, s.y + 8), glm::dvec2(s.x - 8, s.y + 8)}, 2}}},
        {"edge along the side", {{{glm::dvec2(s.x + R, s.y - 8), glm::dvec2(s.x + R, s.y + 8), glm::dvec2(s.x + 20, s.y)}, 2}}},
        {"edge along the top", {{{glm::dvec2(s.x - 8, s.y - R), glm::dvec2(s.x + 8, s.y - R), glm::dvec2(s.x, s.y - 20)}, 2}}},
        {"tangent", {{{glm::dvec2(s.x - 8, s.y + R), glm::dvec2(s.x + 8, s.y + R), glm::dvec2(s.x, s.y + 20)}, 2}}},
        {"island", {{{onGrid(s + 0.1), onGrid(s + 0.1) + glm::dvec2(0x1p-32, 0), onGrid(s + 0.1) + glm::dvec2(0, 0x1p-32)}, 3}}},
        {"sliver", {{{glm::dvec2(s.x - 30, s.y), glm::dvec2(s.x + 30, s.y + 0x1p-32), glm::dvec2(s.x + 30, s.y)}, 3}}},
    };
}

TEST(PixelWeights, SumExactlyOneOnHardMaps) {
    for (const char* name : kFilters) {
        const Prefilter filter = makePrefilter(name, {}, {});
        PixelWeights weights(filter);
        for (const auto& [title, triangles] : hardMaps(filter.radius)) {
            const auto segments = segmentsOf(triangles);
            for (const auto& pixel : weightsOf(weights, filter.radius, triangles, segments, {3.5, 4.5}))
                EXPECT_EQ(sum(pixel), std::int64_t{1} << 60) << name << ", " << title;
        }
        EXPECT_EQ(weights.label_conflicts(), 0u) << name;
    }
}

/// By symmetry, or because everything is covered, these weights are known.
TEST(PixelWeights, HandMadeMapsGiveTheirKnownWeights) {
    for (const char* name : kFilters) {
        const Prefilter filter = makePrefilter(name, {}, {});
        PixelWeights weights(filter);
        const auto get = [&](const std::vector<MapTriangle>& t) {
            return weightsOf(weights, filter.radius, t, segmentsOf(t), {3.5, 4.5}, 1)[0];
        };
        // the diagonal halves each of these kernels: a few roundings of 2^-53
        const auto square = get(squareAround({3.5, 4.5}, 64));
        EXPECT_EQ(square.count(kBackground), 0u) << name;
        EXPECT_LE(std::abs(toDouble(square.at(0)) - 0.5), 16 * 0x1p-53) << name;
        EXPECT_LE(std::abs(toDouble(square.at(1)) - 0.5), 16 * 0x1p-53) << name;
        const auto covered = get(fanAround({3.5, 4.5}, 40, 4));
        for (Owner i = 0; i < 4 && filter.radial(); ++i) {
            EXPECT_LE(std::abs(toDouble(covered.at(i)) - 0.25), 8 * 0x1p-53) << name;
        }
        // an island of 2^-65 square pixels: kernel value times area, and the rest is background's
        const auto island = hardMaps(filter.radius)[11].second;
        const auto tiny = get(island);
        const double expected = evaluate(filter, 0.1, 0.1) * 0x1p-65;
        const double got = tiny.count(3) ? toDouble(tiny.at(3)) : 0.0;
        EXPECT_LE(std::abs(got - expected), 12 * 0x1p-53) << name;  // three terms of up to 4 u
    }
}

std::vector<MapTriangle> randomFan(std::mt19937& random, double R) {
    std::uniform_real_distribution<double> place(-1.5, 1.5);
    const glm::dvec2 hub = onGrid({3.5 + R * place(random), 4.5 + R * place(random)});
    return fanAround(hub, R * std::exp2(2 * place(random)), 3 + static_cast<int>(random() % 30));
}

TEST(PixelWeights, OrderLanesAndTranslationLeaveTheBits) {
    std::printf("seed %u\n", kSeed);
    std::mt19937 random(kSeed);
    for (const char* name : kFilters) {
        const Prefilter filter = makePrefilter(name, {}, {});
        PixelWeights weights(filter);
        for (int round = 0; round < 50; ++round) {
            auto triangles = randomFan(random, filter.radius);
            auto segments = segmentsOf(triangles);
            const Weights all = weightsOf(weights, filter.radius, triangles, segments, {0.5, 4.5});
            std::shuffle(segments.begin(), segments.end(), random);
            EXPECT_EQ(all, weightsOf(weights, filter.radius, triangles, segments, {0.5, 4.5})) << name;
            for (int i = 0; i < 8; ++i)
                EXPECT_EQ(all[i], weightsOf(weights, filter.radius, triangles, segments, {0.5 + i, 4.5}, 1)[0]) << name;
            for (MapSegment& s : segments)
                for (glm::dvec2* p : {&s.segment.a.grid, &s.segment.b.grid, &s.line.origin}) *p += glm::dvec2(4096, -777);
            for (MapTriangle& t : triangles)
                for (glm::dvec2& p : t.p) p += glm::dvec2(4096, -777);
            EXPECT_EQ(all, weightsOf(weights, filter.radius, triangles, segments, {4096.5, 4.5 - 777})) << name;
        }
        EXPECT_EQ(weights.label_conflicts(), 0u) << name;
    }
}

TEST(PixelWeights, InstructionSetsAgreeBitForBit) {
    const char* const sets[] = {"scalar", "sse2", "avx2", "avx512"};
    std::mt19937 random(kSeed);
    int compared = 0;
    for (const char* name : kFilters) {
        const Prefilter filter = makePrefilter(name, {}, {});
        for (int round = 0; round < 20; ++round) {
            const auto triangles = randomFan(random, filter.radius);
            const auto segments = segmentsOf(triangles);
            Weights reference;
            for (const char* set : sets) {
                if (!edgeTermsFor(set)) continue;
                setenv("EDGEWISE_ISA", set, 1);
                PixelWeights weights(filter);
                const Weights got = weightsOf(weights, filter.radius, triangles, segments, {0.5, 4.5});
                if (reference.empty()) reference = got;
                EXPECT_EQ(reference, got) << name << ", " << set;
                ++compared;
            }
            unsetenv("EDGEWISE_ISA");
        }
    }
    std::printf("%d maps compared\n", compared);
}

}  // namespace
}  // namespace edgewise::test
