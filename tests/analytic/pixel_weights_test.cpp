#include "analytic/pixel_weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>

#include "analytic/edge_integral.h"
#include "tests/analytic/triangle_map.h"

namespace edgewise::test {
namespace {

constexpr std::uint32_t kSeed = 20130513;
const char* const kFilters[] = {
    "box",     "disk",     "tent",        "cone",       "gaussian", "gaussian-separable",
    "bspline", "mitchell", "catmull-rom", "bc:0.2,0.4", "lanczos",  "poly:1,-2,1"};

double onGrid(double x) {
    return std::round(x * 0x1p32) * 0x1p-32;
}
glm::dvec2 onGrid(glm::dvec2 p) {
    return {onGrid(p.x), onGrid(p.y)};
}

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

/// Maps that a weight stage has reason to fear, around the sample (3.5, 4.5).
std::vector<std::pair<std::string, std::vector<MapTriangle>>> hardMaps(double R) {
    const glm::dvec2 s{3.5, 4.5};
    return {
        {"triangle", {{{onGrid({1.2, 2.1}), onGrid({5.7, 3.9}), onGrid({2.3, 6.6})}, 7}}},
        {"square", squareAround(s, 64)},
        {"fan on the sample", fanAround(s, 40, 1000)},
        {"fan inside", fanAround(onGrid(s + 0.3 * R), 0.25 * R, 12)},
        {"vertex on the border", fanAround({s.x + R, s.y + R}, 0.75 * R, 7)},
        {"vertex on the upper corner", fanAround({s.x + R, s.y - R}, 0.75 * R, 40)},
        {"vertex on the lower corner", fanAround({s.x + R, s.y + R}, 0.75 * R, 41)},
        {"vertex on the axis, many edges", fanAround({s.x + R, s.y}, 0.75 * R, 300)},
        {"edge along the left side",
         {{{glm::dvec2(s.x - R, s.y - 8), glm::dvec2(s.x - R, s.y + 8), glm::dvec2(s.x - 20, s.y)}, 2}}},
        {"triangles across the axis at the border",
         {{{glm::dvec2(s.x + R, s.y), glm::dvec2(s.x + R + 9, s.y - 5), glm::dvec2(s.x + R + 9, s.y + 7)},
           2}}},
        {"triangle inside, touching the axis at the border",
         {{{glm::dvec2(s.x + R, s.y), glm::dvec2(s.x, s.y - 0.25 * R), glm::dvec2(s.x, s.y + 0.25 * R)}, 2}}},
        {"vertex on the axis", fanAround({s.x + R, s.y}, 0.75 * R, 7)},
        {"vertex on the left of the axis", fanAround({s.x - R, s.y}, 3 * R, 9)},
        {"edge through the sample",
         {{{glm::dvec2(s.x - 8, s.y - 8), glm::dvec2(s.x + 8, s.y + 8), glm::dvec2(s.x - 8, s.y + 8)}, 2}}},
        {"edge along the side",
         {{{glm::dvec2(s.x + R, s.y - 8), glm::dvec2(s.x + R, s.y + 8), glm::dvec2(s.x + 20, s.y)}, 2}}},
        {"edge along the top",
         {{{glm::dvec2(s.x - 8, s.y - R), glm::dvec2(s.x + 8, s.y - R), glm::dvec2(s.x, s.y - 20)}, 2}}},
        {"tangent",
         {{{glm::dvec2(s.x - 8, s.y + R), glm::dvec2(s.x + 8, s.y + R), glm::dvec2(s.x, s.y + 20)}, 2}}},
        {"island",
         {{{onGrid(s + 0.1), onGrid(s + 0.1) + glm::dvec2(0x1p-32, 0),
            onGrid(s + 0.1) + glm::dvec2(0, 0x1p-32)},
           3}}},
        {"sliver",
         {{{glm::dvec2(s.x - 30, s.y), glm::dvec2(s.x + 30, s.y + 0x1p-32), glm::dvec2(s.x + 30, s.y)}, 3}}},
    };
}

std::vector<MapTriangle> mapNamed(double R, const std::string& name) {
    for (const auto& [title, triangles] : hardMaps(R))
        if (title == name) return triangles;
    throw std::logic_error(name);
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
        const auto island = mapNamed(filter.radius, "island");
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
                EXPECT_EQ(all[i],
                          weightsOf(weights, filter.radius, triangles, segments, {0.5 + i, 4.5}, 1)[0])
                    << name;
            for (MapSegment& s : segments)
                for (glm::dvec2* p : {&s.segment.a.grid, &s.segment.b.grid, &s.line.origin})
                    *p += glm::dvec2(4096, -777);
            for (MapTriangle& t : triangles)
                for (glm::dvec2& p : t.p) p += glm::dvec2(4096, -777);
            EXPECT_EQ(all, weightsOf(weights, filter.radius, triangles, segments, {4096.5, 4.5 - 777}))
                << name;
        }
        EXPECT_EQ(weights.label_conflicts(), 0u) << name;
    }
}

/// Total variation of the kernel in x and in y: moving the sample by e px moves a weight by at most e times
/// this.
double variation(const Prefilter& filter) {
    constexpr int kSteps = 400;
    const double step = 2.1 * filter.radius / kSteps;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const double x = (i - kSteps / 2 + 0.5) * step, y = (j - kSteps / 2 + 0.5) * step,
                         here = evaluate(filter, x, y);
            sum += step * (std::abs(evaluate(filter, x + step, y) - here) +
                           std::abs(evaluate(filter, x, y + step) - here));
        }
    }
    return 1.1 * sum;  // the grid misses some of it
}

double largestDifference(const std::map<Owner, FixedWeight>& a, const std::map<Owner, FixedWeight>& b) {
    double largest = 0;
    std::map<Owner, FixedWeight> all = a;
    for (const auto& [owner, weight] : b) all[owner] -= weight;
    for (const auto& [owner, weight] : all) largest = std::max(largest, std::abs(toDouble(weight)));
    return largest;
}

/// Every end of the map moved by its own tiny amount, the same for all segments that share it: as visibility
/// rounds them.
std::vector<MapSegment> nudgedEnds(std::vector<MapSegment> segments, double size, std::mt19937& random) {
    std::uniform_real_distribution<double> nudge(-size, size);
    std::map<std::array<double, 2>, glm::dvec2> moved;
    for (MapSegment& s : segments)
        for (FinePoint* p : {&s.segment.a, &s.segment.b})
            p->rest = moved.try_emplace({p->grid.x, p->grid.y}, nudge(random), nudge(random)).first->second;
    return segments;
}

/// A wrong label on the border shows as a jump: here nothing may move by more than the kernel's variation
/// allows.
TEST(PixelWeights, HardMapsAreContinuousAcrossTheirHardSpots) {
    std::mt19937 random(kSeed);
    double worst_shift = 0, worst_nudge = 0;
    for (const char* name : kFilters) {
        const Prefilter filter = makePrefilter(name, {}, {});
        PixelWeights weights(filter);
        const double tv = variation(filter);
        for (const auto& [title, triangles] : hardMaps(filter.radius)) {
            const auto segments = segmentsOf(triangles);
            const std::vector<MapTriangle>& map = triangles;
            const auto get = [&](const std::vector<MapSegment>& list, glm::dvec2 s) {
                return weightsOf(weights, filter.radius, map, list, s, 1)[0];
            };
            const auto here = get(segments, {3.5, 4.5});
            const double rounding = static_cast<double>(segments.size()) * 16 * 0x1p-53;
            for (glm::dvec2 step : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1),
                                    glm::dvec2(-1, 1)}) {
                const double moved =
                    largestDifference(here, get(segments, glm::dvec2(3.5, 4.5) + 0x1p-32 * step));
                worst_shift = std::max(worst_shift, moved / (tv * 0x1p-31 + rounding));
                EXPECT_LE(moved, tv * 0x1p-31 + rounding) << name << ", " << title;
            }
            for (int i = 0; i < 20;
                 ++i) {  // each edge may tilt: its own triangle of 2^-50 px times its length in the support
                const double bound =
                    rounding + static_cast<double>(segments.size()) * tv * 0x1p-50 * (1 + filter.radius);
                const double moved =
                    largestDifference(here, get(nudgedEnds(segments, 0x1p-51, random), {3.5, 4.5}));
                worst_nudge = std::max(worst_nudge, moved / bound);
                EXPECT_LE(moved, bound) << name << ", " << title;
            }
        }
        EXPECT_EQ(weights.label_conflicts(), 0u) << name;
    }
    std::printf("seed %u; worst shift %.3f, worst nudge %.3f of their bounds\n", kSeed, worst_shift,
                worst_nudge);
}

/// Cells of `cell` px cut along random diagonals, random owners, holes: vertices and edges lie on samples,
/// sides and corners.
std::vector<MapTriangle> randomTiles(std::mt19937& random, double cell) {
    std::vector<MapTriangle> tiles;
    for (int i = -10; i < 10; ++i) {
        for (int j = -10; j < 10; ++j) {
            const glm::dvec2 a{3.5 + i * cell, 4.5 + j * cell}, b = a + glm::dvec2(cell, 0), c = a + cell,
                                                                d = a + glm::dvec2(0, cell);
            const bool falling = random() % 2;
            const std::array<glm::dvec2, 3> halves[2] = {{a, b, falling ? c : d}, {falling ? a : b, c, d}};
            for (const auto& half : halves)
                if (const Owner owner = random() % 6; owner < 5) tiles.push_back({half, owner});
        }
    }
    return tiles;
}

TEST(PixelWeights, TilesOnTheSamplesGridAreContinuous) {
    std::mt19937 random(kSeed);
    double worst = 0;
    int touching = 0;
    for (const char* name : kFilters) {
        const Prefilter filter = makePrefilter(name, {}, {});
        PixelWeights weights(filter);
        const double tv = variation(filter);
        for (int round = 0; round < 12; ++round) {
            const auto triangles = randomTiles(random, round % 3 == 0 ? 1.0 : round % 3 == 1 ? 0.5 : 0.25);
            const auto segments = segmentsOf(triangles);
            const auto get = [&](glm::dvec2 s) {
                return weightsOf(weights, filter.radius, triangles, segments, s, 1)[0];
            };
            const auto here = get({3.5, 4.5});
            const double bound = tv * 0x1p-31 + static_cast<double>(segments.size()) * 16 * 0x1p-53;
            for (glm::dvec2 step : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1),
                                    glm::dvec2(1, 1)}) {
                const double moved = largestDifference(here, get(glm::dvec2(3.5, 4.5) + 0x1p-32 * step));
                worst = std::max(worst, moved / bound);
                EXPECT_LE(moved, bound) << name << ", round " << round;
            }
            for (const MapSegment& s : segments)
                touching += s.segment.a.grid.x == 3.5 + filter.radius &&
                            std::abs(s.segment.a.grid.y - 4.5) <= filter.radius;
        }
        EXPECT_EQ(weights.label_conflicts(), 0u) << name;
    }
    std::printf("seed %u, worst %.3f of its bound, %d segments end on the side\n", kSeed, worst, touching);
    EXPECT_GT(touching, 500);
}

TEST(PixelWeights, SwappingTheOwnersFlipsTheSignExactly) {
    std::mt19937 random(kSeed);
    for (const char* name : kFilters) {
        const Prefilter filter = makePrefilter(name, {}, {});
        PixelWeights weights(filter);
        const Owner base[8] = {9, 9, 9, 9, 9, 9, 9, 9};
        for (const MapSegment& s : segmentsOf(randomFan(random, filter.radius))) {
            std::vector<OwnerWeight> out;
            std::size_t offset[9];
            weights.begin({0.5, 4.5}, 8);
            weights.add(s.segment, s.line, 1, 2);
            weights.add(s.segment, s.line, 2, 1);
            weights.add(s.segment, s.line, 3, 3);
            weights.finish(base, out, offset);
            for (int i = 0; i < 8; ++i) {
                std::int64_t total = 0;
                for (std::size_t k = offset[i]; k < offset[i + 1]; ++k) total += out[k].weight;
                EXPECT_EQ(total, std::int64_t{1} << 60) << name;
                EXPECT_LE(offset[i + 1] - offset[i], 1u) << name;  // both cancel: one owner has it all
            }
        }
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
            for (const Precision precision : {Precision::kFp64, Precision::kFp32}) {
                Weights reference;
                for (const char* set : sets) {
                    if (!edgeTermsFor(set, precision)) continue;
                    setenv("EDGEWISE_ISA", set, 1);
                    PixelWeights weights(filter, precision);
                    const Weights got = weightsOf(weights, filter.radius, triangles, segments, {0.5, 4.5});
                    if (reference.empty()) reference = got;
                    EXPECT_EQ(reference, got) << name << ", " << set;
                    ++compared;
                }
                unsetenv("EDGEWISE_ISA");
            }
        }
    }
    std::printf("%d maps compared\n", compared);
}

}  // namespace
}  // namespace edgewise::test
