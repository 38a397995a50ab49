// ctss-x on small pictures whose edges are lines in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "tests/pipeline/edge_pictures.h"

namespace edgewise::test {
namespace {

using sdf::Kind;

constexpr unsigned kSeed = 20236;

/// Edges of which coverage is known: pixels of them, and how far those are off. A corner of a pixel that
/// reaches past the edge by less than hits float is not seen.
struct EdgeErrors {
    int edges = 0;
    double worst = 0.0, worst_corner = 0.0;

    void judge(const MethodResult& seen, const Edge& edge, double floats) {
        const double reach = 0.5 * (std::abs(edge.n.x) + std::abs(edge.n.y));
        const double corner = boxShare(edge.n, reach - floats);
        forPixels([&](int x, int y) {
            const double exact = boxShare(edge, x, y), off = std::abs(redOf(seen, x, y) - exact);
            const bool hidden = 1.0 - exact <= corner;
            edges += exact > 1e-9 && exact < 1.0 - 1e-9;
            double& most = hidden ? worst_corner : worst;
            most = std::max(most, off);
            EXPECT_LE(off, hidden ? corner + kRounding : kRounding) << x << "," << y;
        });
    }
    void print() const {
        std::printf("%d edge pixels off by at most %.1e; corners not seen %.4f\n", edges, worst,
                    worst_corner);
    }
};

/// A straight edge that all rays pass at a right angle is a line in closed form.
TEST(ConesAndLines, AWallsEdgeIsExact) {
    EdgeErrors errors;
    std::mt19937 random(kSeed);
    std::printf("seed %u\n", kSeed);
    std::uniform_real_distribution<> turn(5.0, 40.0), offset(-0.5, 0.5);
    for (int i = 0; i < 12; ++i) {
        const Edge edge = edgeAt(turn(random) + 90.0 * (i % 4), offset(random));
        errors.judge(wallPicture(edge).made("ctss-x"), edge, kHardX);
    }
    errors.print();
    EXPECT_GT(errors.edges, 200);
}

/// Two faces that lean apart from the view meet in an edge; the field is the greater one of their distances,
/// one of them shrunk. Its outline is a line in closed form.
TEST(ConesAndLines, TheOutlineOfAnIntersectionIsExact) {
    EdgeErrors errors;
    std::mt19937 random(kSeed);
    std::printf("seed %u\n", kSeed);
    std::uniform_real_distribution<> turn(5.0, 40.0), offset(-0.5, 0.5), lean(20.0, 70.0), shrink(0.3, 1.0);
    for (int i = 0; i < 12; ++i) {
        const Edge edge = edgeAt(turn(random) + 90.0 * (i % 4), offset(random));
        FieldPicture picture = flatPicture(kSide, kSide);
        sdf::Tree& tree = picture.field->tree;
        const auto face = [&](double degrees) {
            const double angle = glm::radians(degrees);
            return tree.add(Kind::kPlane, {std::cos(angle), 0, std::sin(angle), 0});
        };
        const double front = lean(random), back = -lean(random), factor = shrink(random);
        const auto shrunk = tree.add(Kind::kScaleValue, {factor}, {face(i % 2 ? front : back)});
        // A slab of it: else it would reach past the eye.
        const auto box = tree.add(Kind::kBox, {100, 100, 8});
        onEdge(tree, tree.add(Kind::kIntersection, {}, {face(i % 2 ? back : front), shrunk, box}), edge);
        tree.root = static_cast<std::uint32_t>(tree.nodes.size() - 1);
        picture.field->materials[0] = unlitWhite();
        // A hit floats before the front face by kHardX of a value, and so beyond the edge on the film.
        const double floats = kHardX / ((i % 2 ? factor : 1.0) * std::cos(glm::radians(front)));
        errors.judge(picture.made("ctss-x"), edge, floats);
    }
    errors.print();
    EXPECT_GT(errors.edges, 200);
}

/// Rays that begin within a solid meet nothing where they are said to hit.
TEST(ConesAndLines, RaysThatBeginWithinASolidAreNamedAllTheSame) {
    for (const double lean : {20.0, 45.0, 70.0}) {
        FieldPicture picture = flatPicture(kSide, kSide);
        sdf::Tree& tree = picture.field->tree;
        const double angle = glm::radians(lean);
        const auto face = [&](double side) {
            return tree.add(Kind::kPlane, {std::cos(angle), 0, side * std::sin(angle), 0});
        };
        const auto front = face(1.0), back = tree.add(Kind::kScaleValue, {0.5}, {face(-1.0)});
        onEdge(tree, tree.add(Kind::kIntersection, {}, {front, back}), edgeAt(31.0, 0.137));
        tree.root = static_cast<std::uint32_t>(tree.nodes.size() - 1);
        picture.field->materials[0] = unlitWhite();
        const MethodResult seen = picture.made("ctss-x");
        forPixels([&](int x, int y) {
            EXPECT_GE(redOf(seen, x, y), 0.0) << x << "," << y;
            EXPECT_LE(redOf(seen, x, y), 1.0) << x << "," << y;
        });
    }
}

/// A ridge towards the eye, its sides lit apart. Planes are where the surface is: to the rounding of its
/// distance, of 60.
TEST(ConesAndLines, ACreaseIsWhereItsPlanesMeet) {
    const Edge edge = edgeAt(31.0, 0.137);
    FieldPicture picture = flatPicture(kSide, kSide);
    sdf::Tree& tree = picture.field->tree;
    const auto box = tree.add(Kind::kBox, {60, 200, 60});
    const auto turned = tree.add(Kind::kRotate, {0, 1, 0, 45}, {box});
    const double ridge = std::sqrt(0.5) * 60.0;
    onEdge(tree, tree.add(Kind::kTranslate, {0, 0, -ridge}, {turned}), edge);
    tree.root = static_cast<std::uint32_t>(tree.nodes.size() - 1);
    picture.field->materials[0].color = glm::dvec3(1.0);
    sdf::SurfaceLight light;
    light.direction_world = glm::normalize(glm::dvec3(edge.n.x, -edge.n.y, -2.0));
    light.shadows = false;
    picture.field->lights = {light};
    const MethodResult seen = picture.made("ctss-x"), none = picture.made("none");
    double low = HUGE_VAL, high = 0.0;
    forPixels([&](int x, int y) {
        low = std::min(low, redOf(none, x, y)), high = std::max(high, redOf(none, x, y));
    });
    ASSERT_GT(high - low, 0.1);
    double worst = 0.0, worst_none = 0.0;
    int edges = 0;
    forPixels([&](int x, int y) {
        const double share = boxShare(edge, x, y);  // the inner side faces the light
        edges += share > 1e-9 && share < 1.0 - 1e-9;
        worst = std::max(worst, std::abs((redOf(seen, x, y) - low) / (high - low) - share));
        worst_none = std::max(worst_none, std::abs((redOf(none, x, y) - low) / (high - low) - share));
    });
    // The longest chord of a pixel times how far the line may lie off; a corner beyond it by less than a hit
    // floats may be named wrongly, and takes nothing.
    const double off = std::sqrt(2.0) * kHardX * std::sqrt(0.5);
    std::printf("%d edge pixels off by at most %.4f of the step (bound %.4f; none %.2f)\n", edges, worst, off,
                worst_none);
    EXPECT_GT(edges, 20);
    EXPECT_GT(worst_none, 0.4);
    EXPECT_LE(worst, off);
}

/// Mean over all places of a wire within a pixel: what it covers of the picture is its width times its
/// length.
TEST(ConesAndLines, WiresThinnerThanAPixelKeepTheirEnergy) {
    for (const double width : {0.05, 0.2, 0.6}) {
        double sum = 0.0, worst = 0.0;
        constexpr int kShifts = 8;
        for (int shift = 0; shift < kShifts; ++shift) {
            const Edge edge = edgeAt(11.0, (shift + 0.5) / kShifts);
            FieldPicture picture = flatPicture(kSide, kSide);
            sdf::Tree& tree = picture.field->tree;
            onEdge(tree, tree.add(Kind::kBox, {width, 100, 2}), edge);
            tree.root = static_cast<std::uint32_t>(tree.nodes.size() - 1);
            picture.field->materials[0] = unlitWhite();
            const MethodResult seen = picture.made("ctss-x");
            double covered = 0.0, exact = 0.0;
            const Edge left{edge.n, edge.c + 0.5 * width}, right{edge.n, edge.c - 0.5 * width};
            forPixels([&](int x, int y) {
                const double share = boxShare(right, x, y) - boxShare(left, x, y);
                covered += redOf(seen, x, y), exact += share;
                worst = std::max(worst, std::abs(redOf(seen, x, y) - share));
            });
            sum += covered / exact / kShifts;
        }
        std::printf("%.2f px: %.4f of its coverage, a pixel off by at most %.4f\n", width, sum, worst);
        EXPECT_NEAR(sum, 1.0, 0.05) << width;
    }
}

/// A wall over a floor and light from aslant: the shadow's border is the wall's edge, moved.
TEST(ConesAndLines, AShadowsBorderIsSearched) {
    const Edge edge = edgeAt(11.0, -7.3);
    FieldPicture picture = flatPicture(kSide, kSide);
    sdf::Tree& tree = picture.field->tree;
    const auto box = tree.add(Kind::kBox, {100, 100, 1});
    // Beyond the edge: the picture's right; its underside at z = 3.
    const auto wall = onEdge(tree, tree.add(Kind::kTranslate, {50, 0, 0}, {box}), edge, 3.5);
    const auto floor = tree.add(Kind::kPlane, {0, 0, 1, 0});
    tree.root = tree.add(Kind::kUnion, {}, {wall, floor});
    picture.field->materials[0].color = glm::dvec3(1.0);
    sdf::SurfaceLight light;
    const double slope = 2.0;  // px along the floor for each of height
    light.direction_world = glm::normalize(glm::dvec3(-slope * edge.n.x, slope * edge.n.y, -1.0));
    picture.field->lights = {light};
    picture.field->ambient = glm::dvec3(0.1);
    // The light comes from beyond the edge: it passes the upper one, at z = 4, last.
    const Edge shadow{edge.n, edge.c + slope * 4.0};
    const MethodResult seen = picture.made("ctss-x"), none = picture.made("none"),
                       truth = picture.made("ssaa:16");
    double lit = 0.0, dark = HUGE_VAL;
    const auto onFloor = [&](int x, int y) { return edge.at({x + 0.5, y + 0.5}) < -1.0; };
    forPixels([&](int x, int y) {
        if (!onFloor(x, y)) return;
        lit = std::max(lit, redOf(none, x, y)), dark = std::min(dark, redOf(none, x, y));
    });
    ASSERT_GT(lit, 1.5 * dark);
    double worst = 0.0, sum = 0.0, sum_none = 0.0, beside = 0.0;
    int edges = 0;
    forPixels([&](int x, int y) {
        if (!onFloor(x, y)) return;
        const double share = boxShare(shadow, x, y);
        edges += share > 1e-9 && share < 1.0 - 1e-9;
        const auto off = [&](const MethodResult& r) {
            return std::abs((redOf(r, x, y) - dark) / (lit - dark) - share);
        };
        worst = std::max(worst, off(seen)), sum += off(seen) * off(seen);
        sum_none += off(none) * off(none);
        beside += std::pow((redOf(seen, x, y) - redOf(truth, x, y)) / (lit - dark), 2);
    });
    const auto rms = [&](double squares) { return std::sqrt(squares / edges); };
    std::printf("%d border pixels off by at most %.4f, rms %.4f (none %.4f); off ssaa:16 by rms %.4f\n",
                edges, worst, rms(sum), rms(sum_none), rms(beside));
    EXPECT_GT(edges, 20);
    EXPECT_GT(rms(sum_none), 0.2);
    // Hits float over the floor by up to kHardX, and light's rays end as far from the wall: each moves the
    // border by that times the slope, along a chord of at most sqrt(2).
    EXPECT_LE(worst, std::sqrt(2.0) * slope * 2.0 * kHardX);
    // That moves the border of all methods alike; a column of 16 is what ssaa:16 itself is off by.
    EXPECT_LE(rms(beside), 1.0 / 16.0);
}

/// Squares along the pixels' axes, seen from above: shares of both colours are products of overlaps.
TEST(ConesAndLines, CheckersAreAveraged) {
    constexpr double kSquare = 2.3;
    FieldPicture picture = flatPicture(kSide, kSide);
    picture.field->tree.add(Kind::kPlane, {0, 0, 1, 0});
    picture.field->materials[0] = unlitWhite();
    picture.field->materials[0].pattern = sdf::SurfaceMaterial::Pattern::kChecker;
    picture.field->materials[0].pattern_size = kSquare;
    const MethodResult seen = picture.made("ctss-x");
    // Mean of +1 and -1 by squares over an interval of length 1, by lengths.
    const auto sign = [&](double from) {
        double sum = 0.0;
        for (double x = from; x < from + 1.0;) {
            const double cell = std::floor(x / kSquare), end = std::min((cell + 1.0) * kSquare, from + 1.0);
            sum += (static_cast<long>(cell) & 1 ? -1.0 : 1.0) * (end - x);
            x = end > x ? end : std::nextafter(x, HUGE_VAL);
        }
        return sum;
    };
    double worst_same = 0.0, worst_other = 0.0;
    int mixed = 0;
    forPixels(
        [&](int x, int y) {
            const double product = sign(x - 0.5 * kSide) * sign(0.5 * kSide - y - 1.0);
            mixed += std::abs(product) < 0.999;
            worst_same = std::max(worst_same, std::abs(redOf(seen, x, y) - 0.5 * (1.0 + product)));
            worst_other = std::max(worst_other, std::abs(redOf(seen, x, y) - 0.5 * (1.0 - product)));
        },
        1);
    std::printf("%d pixels of both colours, off by at most %.2e\n", mixed, std::min(worst_same, worst_other));
    EXPECT_GT(mixed, 250);
    // Places up to kSide / 2 away, some ten borders. Which colour comes first is the pattern's own.
    EXPECT_LE(std::min(worst_same, worst_other), 10.0 * 10.0 * 0x1p-52 * kSide);
}

}  // namespace
}  // namespace edgewise::test
