// Which pixels have few edges, against segments clipped to each pixel's support one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "pipeline/methods/edge_classes.h"
#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

constexpr int kSize = 24;

/// World units are pixels: x right, y up, the film's centre at the origin.
glm::vec3 atPixel(double x, double y) {
    return {float(x - kSize / 2.0), float(kSize / 2.0 - y), -1.0f};
}

std::vector<EdgeClass> classesOf(const std::vector<test::Corners>& triangles, const Prefilter& filter) {
    const Scene scene = test::makeScene({test::makeGeometry(triangles)});
    const ResolvedCamera camera = test::makeOrthographic(kSize / 2.0);
    const Film film = test::makeFilm(kSize, kSize);
    const RenderOptions options;
    Progress progress;
    return edgeClasses({scene, camera, film, filter, options, progress});
}

/// Whether a piece of a-b lies in the open square (Liang and Barsky's clipping).
bool meets(glm::dvec2 a, glm::dvec2 b, glm::dvec2 sample, double radius) {
    double from = 0.0, to = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
        const double step = b[axis] - a[axis];
        const double low = sample[axis] - radius - a[axis], high = sample[axis] + radius - a[axis];
        if (step == 0.0) {
            if (low >= 0.0 || high <= 0.0) return false;
            continue;
        }
        from = std::max(from, std::min(low / step, high / step));
        to = std::min(to, std::max(low / step, high / step));
    }
    return from < to;
}

TEST(EdgeClasses, CountTheEdgesInEverySupport) {
    const unsigned seed = 20261127;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> inside(1.0, kSize - 1.0);
    std::map<EdgeClass, int> met;
    for (const double radius : {0.5, 2.0})
        for (int round = 0; round < 50; ++round) {
            std::array<glm::dvec2, 3> corner;
            for (glm::dvec2& c : corner) c = {inside(random), inside(random)};
            test::Corners triangle;
            for (int i = 0; i < 3; ++i) {
                triangle[i] = atPixel(corner[i].x, corner[i].y);
                corner[i] = {triangle[i].x + kSize / 2.0, kSize / 2.0 - triangle[i].y};
            }
            const std::vector<EdgeClass> classes = classesOf({triangle}, makePrefilter("box", radius, {}));
            for (int y = 0; y < kSize; ++y)
                for (int x = 0; x < kSize; ++x) {
                    int edges = 0;
                    for (int i = 0; i < 3; ++i)
                        edges += meets(corner[i], corner[(i + 1) % 3], {x + 0.5, y + 0.5}, radius);
                    const EdgeClass expected = edges == 0   ? EdgeClass::kNoEdge
                                               : edges <= 2 ? EdgeClass::kFew
                                                            : EdgeClass::kOthers;
                    ++met[expected];
                    ASSERT_EQ(classes[y * kSize + x], expected)
                        << "seed " << seed << " round " << round << " pixel " << x << "," << y;
                }
        }
    for (const EdgeClass edge_class : {EdgeClass::kNoEdge, EdgeClass::kFew, EdgeClass::kOthers})
        EXPECT_GT(met[edge_class], 100);
}

/// Two triangles that shade alike make a rectangle: its diagonal is no edge, its sides are parallel to the
/// axes.
TEST(EdgeClasses, KnowAxesAndAlikeOwners) {
    const glm::vec3 a = atPixel(4.25, 4.25), b = atPixel(20.25, 4.25), c = atPixel(20.25, 20.25),
                    d = atPixel(4.25, 20.25);
    const std::vector<EdgeClass> classes = classesOf({{a, b, c}, {a, c, d}}, makePrefilter("box", 0.5, {}));
    const auto at = [&](int x, int y) { return classes[y * kSize + x]; };
    EXPECT_EQ(at(12, 12), EdgeClass::kNoEdge) << "on the diagonal";
    EXPECT_EQ(at(12, 4), EdgeClass::kOthers) << "on a horizontal side";
    EXPECT_EQ(at(20, 12), EdgeClass::kOthers) << "on a vertical side";
    EXPECT_EQ(at(1, 1), EdgeClass::kNoEdge);
}

}  // namespace
}  // namespace edgewise
