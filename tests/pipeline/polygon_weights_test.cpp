// Convex polygons in prefilters, against nested quadrature, and what ctss-x makes of them.
#include "pipeline/methods/polygon_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "sdf/film_line.h"
#include "tests/pipeline/field_pictures.h"
#include "tests/witness/scanline_quadrature.h"
#include "tests/witness/scene_builder.h"

namespace edgewise::test {
namespace {

constexpr unsigned kSeed = 20241;

using Polygon = std::vector<glm::dvec2>;

/// What is left of a pixel after up to four cuts.
Polygon randomPart(std::mt19937& random, const glm::dvec2& centre) {
    std::uniform_real_distribution<> angle(0.0, 6.2831853), offset(-0.4, 0.4);
    std::uniform_int_distribution<> cuts(0, 4);
    std::vector<sdf::FilmLine> lines;
    for (int k = cuts(random); k > 0; --k) {
        const double a = angle(random);
        const glm::dvec2 n(std::cos(a), std::sin(a));
        lines.push_back({n.x, n.y, offset(random) - glm::dot(n, centre)});
    }
    Polygon part = sdf::squareWithin(centre, lines);
    for (glm::dvec2& p : part) p = witness::toGrid(p);
    return part;
}

/// The polygon as a fan.
witness::SceneBuilder fanOf(const Polygon& polygon) {
    witness::SceneBuilder scene(polygon[0]);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        scene.add(
            {glm::dvec3(polygon[0], 0.5), glm::dvec3(polygon[i - 1], 0.5), glm::dvec3(polygon[i], 0.5)});
    return scene;
}

TEST(PolygonWeights, AreTheQuadraturesOfTheirFans) {
    std::mt19937 random(kSeed);
    std::printf("seed %u\n", kSeed);
    const glm::dvec2 centre(50.5, 30.5);
    for (const char* name : {"box", "disk", "tent", "cone", "gaussian", "mitchell"}) {
        const Prefilter filter = makePrefilter(name, {}, {});
        const witness::ScanlineQuadrature judge(witness::kernelLike(filter), 1e-13L);
        PolygonWeights weights(filter);
        double worst = 0.0, estimate = 0.0;
        int met = 0;
        for (int round = 0; round < 6; ++round) {
            const Polygon part = randomPart(random, centre);
            if (sdf::areaOf(part) < 1e-3) continue;
            std::vector<PixelShare> shares;
            weights.add(part, shares);
            std::map<std::pair<int, int>, double> of;
            for (const PixelShare& share : shares) of[{share.x, share.y}] = share.weight;
            const witness::SceneBuilder fan = fanOf(part);
            for (int y = 28; y <= 32; ++y)
                for (int x = 48; x <= 52; ++x) {
                    const auto judged = judge.judge(fan.scene(), {x + 0.5, y + 0.5});
                    double expected = 0.0;
                    for (const auto& [owner, weight] : judged.weight)
                        if (owner != kBackground) expected += static_cast<double>(weight);
                    const auto found = of.find({x, y});
                    const double off = std::abs((found == of.end() ? 0.0 : found->second) - expected);
                    worst = std::max(worst, off), met += expected != 0.0;
                    estimate = std::max(estimate, static_cast<double>(judged.error));
                    // A term's 16 u each for up to eight sides, and the fixed point's rounding of each.
                    EXPECT_LE(off, 2.0 * static_cast<double>(judged.error) + 8.0 * (16.0 * 0x1p-53 + 0x1p-61))
                        << name << " " << x << "," << y;
                }
        }
        std::printf("%-10s %3d weights off by at most %.1e (the quadrature's own error %.1e)\n", name, met,
                    worst, estimate);
        EXPECT_GE(met, 4);
    }
}

/// All parts of a pixel weigh what the pixel does.
TEST(PolygonWeights, OfPartsAddUp) {
    std::mt19937 random(kSeed + 1);
    const glm::dvec2 centre(-7.5, 1000.5);
    const Prefilter filter = makePrefilter("gaussian", {}, {});
    PolygonWeights weights(filter);
    std::uniform_real_distribution<> angle(0.0, 6.2831853), offset(-0.6, 0.6);
    for (int round = 0; round < 50; ++round) {
        const double a = angle(random);
        const glm::dvec2 n(std::cos(a), std::sin(a));
        const sdf::FilmLine line{n.x, n.y, offset(random) - glm::dot(n, centre)};
        const Polygon square = sdf::squareWithin(centre, {});
        std::map<std::pair<int, int>, double> sum;
        const auto add = [&](const Polygon& polygon, double sign) {
            std::vector<PixelShare> shares;
            if (!polygon.empty()) weights.add(polygon, shares);
            for (const PixelShare& share : shares) sum[{share.x, share.y}] += sign * share.weight;
        };
        add(square, -1.0), add(sdf::within(square, line), 1.0),
            add(sdf::within(square, line.reversed()), 1.0);
        // Where the halves meet, both round the line's ends to the grid: at most 2^-32 px over a chord.
        for (const auto& [pixel, off] : sum) EXPECT_NEAR(off, 0.0, 4.0 * 0x1p-32) << pixel.first;
    }
}

/// A white box that turns to the eye before black: `nsaa`'s pictures of its mesh are those of its field.
TEST(PolygonWeights, ABoxIsItsMeshInEveryFilter) {
    constexpr int kSide = 24;
    const double turn = glm::radians(27.0);
    const glm::dvec3 half(6.3, 4.1, 3.0);
    for (const char* name : {"box", "cone", "gaussian"}) {
        FieldPicture picture = flatPicture(kSide, kSide);
        sdf::Tree& tree = picture.field->tree;
        const auto box = tree.add(sdf::Kind::kBox, {2 * half.x, 2 * half.y, 2 * half.z});
        tree.root = tree.add(sdf::Kind::kRotate, {0, 0, 1, glm::degrees(turn)}, {box});
        picture.field->materials[0] = unlitWhite();
        picture.filter = makePrefilter(name, {}, {});
        const MethodResult seen = picture.made("ctss-x:weights=filter");
        const witness::ScanlineQuadrature judge(witness::kernelLike(picture.filter), 1e-10L);
        Polygon face;
        for (const glm::dvec2& s : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
            const glm::dvec2 p = s * glm::dvec2(half);
            const glm::dvec2 q(p.x * std::cos(turn) - p.y * std::sin(turn),
                               p.x * std::sin(turn) + p.y * std::cos(turn));
            face.push_back(witness::toGrid(glm::dvec2(0.5 * kSide + q.x, 0.5 * kSide - q.y)));
        }
        const witness::SceneBuilder fan = fanOf(face);
        double squares = 0.0, worst = 0.0, worst_vertex = 0.0;
        int edges = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const glm::dvec2 centre(x + 0.5, y + 0.5);
                const double reach = picture.filter.radius + 1.5;
                const bool vertex = std::ranges::any_of(face, [&](const glm::dvec2& v) {
                    return std::max(std::abs(v.x - centre.x), std::abs(v.y - centre.y)) < reach;
                });
                double expected = 0.0;
                for (const auto& [owner, weight] : judge.judge(fan.scene(), centre).weight)
                    if (owner != kBackground) expected += static_cast<double>(weight);
                const double off = std::abs(seen.image.rgba[seen.image.index(x, y)].x - expected);
                (vertex ? worst_vertex : worst) = std::max(vertex ? worst_vertex : worst, off);
                if (vertex || expected < 1e-9 || expected > 1.0 - 1e-9) continue;
                squares += off * off, ++edges;
            }
        std::printf("%-10s %3d contour pixels: rms %.1e, at most %.1e; within reach of a vertex %.1e\n", name,
                    edges, std::sqrt(squares / edges), worst, worst_vertex);
        EXPECT_GT(edges, 10);
        EXPECT_LE(std::sqrt(squares / edges), 1e-3);
    }
}

}  // namespace
}  // namespace edgewise::test
