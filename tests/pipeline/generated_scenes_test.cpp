// Do the scenes hold what their names and docstrings promise?
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "data/generate/degenerate.h"
#include "data/generate/random_triangles.h"
#include "data/generate/recipes.h"
#include "tests/pipeline/plain_gltf.h"

namespace edgewise {
namespace {

using scenes::Recipe;
using test::Point;
using test::Triangle;

std::vector<Triangle> trianglesOf(const std::string& bytes) {
    return test::readTriangles(test::readPlain(bytes));
}

std::string namedBytes(const std::string& name) {
    for (const Recipe& recipe : scenes::namedRecipes()) {
        if (recipe.name == name) return recipe.bytes();
    }
    return "";
}

double crossXY(const Point& a, const Point& b, const Point& c) {
    return (double(b[0]) - a[0]) * (double(c[1]) - a[1]) - (double(b[1]) - a[1]) * (double(c[0]) - a[0]);
}

/// Each directed edge once, and its reverse once: a closed, oriented surface.
void expectClosed(const std::vector<Triangle>& triangles) {
    std::map<std::pair<Point, Point>, int> uses;
    for (const Triangle& t : triangles) {
        for (std::size_t i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
    }
    EXPECT_EQ(uses.size(), 3 * triangles.size());
    for (const auto& [edge, count] : uses) ASSERT_EQ(uses.count({edge.second, edge.first}), 1u);
}

/// Six times the signed volume: positive where front faces look outwards.
double volume6(const std::vector<Triangle>& triangles) {
    double sum = 0.0;
    for (const auto& [a, b, c] : triangles) {
        sum += double(a[0]) * (double(b[1]) * c[2] - double(b[2]) * c[1]) +
               double(a[1]) * (double(b[2]) * c[0] - double(b[0]) * c[2]) +
               double(a[2]) * (double(b[0]) * c[1] - double(b[1]) * c[0]);
    }
    return sum;
}

TEST(GeneratedScenes, HoldAsManyTrianglesAsTheySay) {
    for (const auto* recipes : {&scenes::namedRecipes(), &scenes::degenerateRecipes()}) {
        for (const Recipe& recipe : *recipes) {
            const auto file = test::readPlain(recipe.bytes());
            EXPECT_EQ(test::readTriangles(file).size(), recipe.triangles) << recipe.file;
            EXPECT_EQ(file.json["cameras"].size(), 1u) << recipe.file;
        }
    }
}

TEST(GeneratedScenes, PixelCamerasMapOneUnitToOnePixel) {
    std::size_t orthographic = 0;
    for (const auto* recipes : {&scenes::namedRecipes(), &scenes::degenerateRecipes()}) {
        for (const Recipe& recipe : *recipes) {
            const auto file = test::readPlain(recipe.bytes());
            if (file.json["cameras"][0]["type"] != "orthographic") continue;
            ++orthographic;
            const double half = recipe.width_px / 2.0;
            EXPECT_EQ(file.json["cameras"][0]["orthographic"]["xmag"], half) << recipe.file;
            EXPECT_EQ(file.json["cameras"][0]["orthographic"]["ymag"], half) << recipe.file;
            EXPECT_EQ(file.json["nodes"][0]["translation"], (std::vector{half, half, 4096.0})) << recipe.file;
        }
    }
    EXPECT_EQ(orthographic, 18u);
}

TEST(GeneratedScenes, ZonePlateRingsHaveEqualAreaAndFaceTheEye) {
    const auto triangles = trianglesOf(namedBytes("zone-plate"));
    // 80 chords of a circle enclose 40 sin(2 pi/80) r^2; a zone is 512^2/126 of r^2. Coordinates are floats
    // below 1024, 2^-15 apart at most: half of that in each of two components, along a perimeter of at most 2
    // pi 512 twice.
    const double zone = 40.0 * std::sin(2.0 * M_PI / 80.0) * 512.0 * 512.0 / 126.0;
    const double bound = 2.0 * 2.0 * M_PI * 512.0 * std::sqrt(2.0) * 0x1p-15;
    double worst = 0.0;
    for (std::size_t ring = 0; ring < 125; ++ring) {
        double area = 0.0;
        for (std::size_t i = 160 * ring; i < 160 * (ring + 1); ++i) {
            const double twice = crossXY(triangles[i][0], triangles[i][1], triangles[i][2]);
            ASSERT_GT(twice, 0.0);
            area += 0.5 * twice;
        }
        worst = std::max(worst, std::abs(area - zone));
    }
    RecordProperty("worst_px2", std::to_string(worst));
    EXPECT_LE(worst, bound);
}

TEST(GeneratedScenes, LogGridCoversTheSquareExactlyAndDoublesByAConstant) {
    double twice = 0.0;
    std::set<float> columns;
    for (const auto& [a, b, c] : trianglesOf(namedBytes("log-grid"))) {
        EXPECT_GT(crossXY(a, b, c), 0.0);
        twice += crossXY(a, b, c);
        for (const Point& p : {a, b, c}) columns.insert(p[0]);
    }
    EXPECT_EQ(twice, 2.0 * 1024.0 * 1024.0);  // exact: multiples of 2^-26 below 2^22
    ASSERT_EQ(columns.size(), 102u);
    const std::vector<float> x(columns.begin(), columns.end());
    // Line i lies at log2(1 + i): lines 1, 3, 7, ... are equally far apart, each rounded by at most 2^-14.
    for (const std::size_t i : {1u, 3u, 7u, 15u, 31u})
        EXPECT_NEAR(x[2 * i + 1] - x[i], 1024.0 / std::log2(102.0), 0x1p-13);
}

TEST(GeneratedScenes, ToriAndSpheresAreClosedAndFaceOutwards) {
    for (const char* name : {"torus-20k", "torus-200k"}) {
        const auto torus = trianglesOf(namedBytes(name));
        expectClosed(torus);
        EXPECT_GT(volume6(torus), 0.0);
    }
    const auto sphere = trianglesOf(scenes::makeClosedSphere().glb());
    expectClosed(sphere);
    EXPECT_GT(volume6(sphere), 0.0);
    const auto both = trianglesOf(scenes::makeTwoSpheres().glb());
    expectClosed({both.begin(), both.begin() + 512});
    expectClosed({both.begin() + 512, both.end()});
}

TEST(GeneratedScenes, RandomTrianglesAreFourDeep) {
    for (const std::uint32_t count : {2000u, 20000u, 200000u}) {
        double sum = 0.0, squares = 0.0;
        for (const auto& [a, b, c] : trianglesOf(scenes::makeRandomTriangles(count).glb())) {
            const double area = 0.5 * std::abs(crossXY(a, b, c));
            sum += area;
            squares += area * area;
        }
        const double width = 1024.0 + 2.0 * scenes::greatestCircumradius(count);
        const double depth = sum / (width * width), mean = sum / count;
        const double standard_error = std::sqrt((squares / count - mean * mean) * count) / (width * width);
        std::printf("random %u: depth complexity %.4f, standard error %.4f\n", count, depth, standard_error);
        EXPECT_NEAR(depth, scenes::kDepthComplexity, 4.0 * standard_error);
    }
}

/// +1 where a lies before b everywhere on a grid of their overlap, -1 behind, 0 if neither or no overlap.
int order(const Triangle& a, const Triangle& b) {
    const auto depth = [](const Triangle& t, const Point& p) -> double {
        const double area = crossXY(t[0], t[1], t[2]);
        const double u = crossXY(t[1], t[2], p) / area, v = crossXY(t[2], t[0], p) / area, w = 1.0 - u - v;
        return u < 0 || v < 0 || w < 0 ? std::nan("") : u * t[0][2] + v * t[1][2] + w * t[2][2];
    };
    int before = 0, behind = 0;
    for (float y = 0.125f; y < 64; y += 0.25f) {
        for (float x = 0.125f; x < 64; x += 0.25f) {
            const double za = depth(a, {x, y, 0}), zb = depth(b, {x, y, 0});
            before += za > zb ? 1 : 0;
            behind += za < zb ? 1 : 0;
        }
    }
    return before > 0 && behind == 0 ? 1 : behind > 0 && before == 0 ? -1 : 0;
}

TEST(GeneratedScenes, CyclicOverlapIsACycleAndPiercingPierces) {
    const auto cycle = trianglesOf(scenes::makeCyclicOverlap().glb());
    const int first = order(cycle[0], cycle[1]);
    EXPECT_NE(first, 0);
    EXPECT_EQ(order(cycle[1], cycle[2]), first);
    EXPECT_EQ(order(cycle[2], cycle[0]), first);
    const auto piercing = trianglesOf(scenes::makePiercing().glb());
    EXPECT_EQ(order(piercing[0], piercing[1]), 0);
    EXPECT_EQ(order(piercing[1], piercing[2]), 0);
    EXPECT_EQ(order(piercing[2], piercing[0]), 0);
}

TEST(GeneratedScenes, CoplanarMeansCoplanarToTheLastBit) {
    for (const auto& [a, b, c] : trianglesOf(scenes::makeCoplanarDuplicates().glb())) {
        for (const Point& p : {a, b, c}) EXPECT_EQ(p[2], 0.25f * p[0] + 0.125f * (64.0f - p[1]));
    }
    for (const auto& [a, b, c] : trianglesOf(scenes::makeDecals().glb())) {
        for (const Point& p : {a, b, c}) EXPECT_EQ(p[2], 0.5f * p[1]);
    }
}

TEST(GeneratedScenes, ExtremesAreReached) {
    double thinnest = 1.0;
    for (const auto& [a, b, c] : trianglesOf(scenes::makeSlivers().glb()))
        thinnest = std::min(thinnest, std::abs(crossXY(a, b, c)) / 18.0);
    EXPECT_FLOAT_EQ(static_cast<float>(thinnest), 1e-5f);
    int empty = 0, behind = 0, cut = 0;
    for (const auto& [a, b, c] : trianglesOf(scenes::makeZeroArea().glb()))
        empty += crossXY(a, b, c) == 0.0 ? 1 : 0;
    for (const auto& [a, b, c] : trianglesOf(scenes::makeNearPlane().glb())) {
        const float nearest = std::max({a[2], b[2], c[2]}), farthest = std::min({a[2], b[2], c[2]});
        behind += farthest > 0 ? 1 : 0;
        cut += nearest > -1 && farthest < -1 ? 1 : 0;
    }
    EXPECT_EQ(empty, 8);
    EXPECT_EQ(behind, 1);
    EXPECT_EQ(cut, 6);
    for (const auto& [a, b, c] : trianglesOf(scenes::makeFan1000().glb()))
        EXPECT_EQ(a, (Point{16.5f, 15.5f, 0.0f}));
}

}  // namespace
}  // namespace edgewise
