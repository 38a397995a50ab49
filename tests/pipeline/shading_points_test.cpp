#include "pipeline/shading_points.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <map>
#include <random>

#include "pipeline/methods/nsaa.h"
#include "pipeline/methods/point_samples.h"
#include "tests/pipeline/nsaa_stages.h"
#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

constexpr int kSidePx = 8;

/// A scene with all that a render wants. Vertex colours keep every triangle's colour from being constant.
struct Stage {
    Scene scene;
    ResolvedCamera camera = test::makeOrthographic(kSidePx / 2.0);  // a world unit is a pixel
    Film film = test::makeFilm(kSidePx, kSidePx);
    Prefilter filter;
    RenderOptions options;
    Progress progress;

    Stage(std::vector<Geometry> geometry, const char* filter_name, ShadingChoice shading)
        : scene(test::makeScene(std::move(geometry))), filter(makePrefilter(filter_name, {}, {})) {
        options.shading = shading;
    }
    MethodInput input() { return {scene, camera, film, filter, options, progress}; }
    ImageBuffer render(const char* method = "nsaa") { return runMethod(parseMethod(method), input()).image; }
};

constexpr ShadingChoice kCentroid{ShadingMode::kCentroid, 1};

/// Triangles that overlap and pierce each other; colours from `color`.
template <class Color>
Geometry triangleSoup(std::mt19937& random, int count, const Color& color) {
    std::uniform_real_distribution<float> side(-5, 5), depth(-9, -1);
    std::vector<test::Corners> triangles(static_cast<std::size_t>(count));
    for (auto& t : triangles)
        for (auto& p : t) p = {side(random), side(random), depth(random)};
    Geometry geometry = test::makeGeometry(triangles);
    for (const glm::dvec3& p : geometry.position_world) geometry.color.push_back(color(p));
    return geometry;
}

glm::dvec4 anyColor(const glm::dvec3& p) {
    return {0.5 + 0.1 * p.x, 0.5 + 0.1 * p.y, 0.5 + 0.05 * p.z, 1.0};
}

/// Corners on halves of a pixel, so that edges run through samples, along rows, and meet at points of the
/// Halton sequence's columns.
Geometry latticeScene() {
    std::vector<test::Corners> triangles;
    for (int y = -4; y < 4; ++y)
        for (int x = -4; x < 4; ++x) {
            const float l = x + 0.5f, r = l + 1.0f, b = y + 0.5f, t = b + 1.0f;
            triangles.push_back({{{l, b, -2}, {r, b, -2}, {r, t, -2}}});
            triangles.push_back({{{l, b, -2}, {r, t, -2}, {l, t, -2}}});
        }
    triangles.push_back({{{-1, -1, -1}, {1, -1, -1}, {0, 1, -1}}});
    Geometry geometry = test::makeGeometry(triangles);
    for (const glm::dvec3& p : geometry.position_world) geometry.color.push_back(anyColor(p));
    return geometry;
}

double toReal(FixedWeight weight) {
    return std::ldexp(static_cast<double>(weight), -kWeightBits);
}

/// A region's centroids by weight sum up to the measure's own, the sample. Each is rounded to the grid;
/// owners of less than 2^-32 have none.
TEST(ShadingPoints, CentroidsBalanceAroundTheSample) {
    for (const char* name : {"gaussian", "cone", "disk", "box", "mitchell", "lanczos", "poly:1,-1.5"}) {
        SCOPED_TRACE(name);
        std::mt19937 random(71);
        Stage stage({triangleSoup(random, 40, anyColor)}, name, kCentroid);
        test::NsaaStages stages(stage.input());
        const Prefilter measure = centroidMeasure(stage.filter);
        Stage area({stage.scene.geometry[0]}, measure.name.c_str(), kCentroid);
        area.filter = measure;
        test::NsaaStages measured(area.input());
        std::size_t shared = 0, measured_pairs = 0, pointless_pairs = 0;
        for (int y = 0; y < kSidePx; ++y)
            for (int x = 0; x < kSidePx; ++x) {
                const WeightTile tile = stages.weigh(x, y), weights = measured.weigh(x, y);
                std::map<Owner, glm::dvec2> points;
                for (std::size_t e = 0; e < tile.entries.size(); ++e)
                    for (const glm::dvec2& offset : tile.points.of(e)) points[tile.entries[e].owner] = offset;
                const double R = stage.filter.radius, terms = 256;  // of one pixel, generously
                glm::dvec2 sum(0.0);
                double bound = 0x1p-32 + terms * 16 * 0x1p-53 * R;
                for (const OwnerWeight& w : weights.entries) {
                    const auto point = points.find(w.owner);
                    if (point != points.end())
                        sum += toReal(w.weight) * point->second;
                    else  // too thin, or in a corner where the filter weighs less than 2^-60
                        bound += R * std::fabs(toReal(w.weight));
                    measured_pairs += point != points.end(), pointless_pairs += point == points.end();
                }
                EXPECT_NEAR(sum.x, 0, bound) << x << " " << y;
                EXPECT_NEAR(sum.y, 0, bound) << x << " " << y;
                shared += tile.entries.size() > 3;
            }
        EXPECT_GT(shared, 10u);
        EXPECT_LT(pointless_pairs, measured_pairs / 20);
    }
}

/// Sums over samples err by about h^1.5 for a step h: 16 and 64 samples a side differ more than 64 and the
/// truth.
TEST(ShadingPoints, CentroidsAgreeWithManySamples) {
    for (const char* name : {"gaussian", "box", "mitchell"}) {
        SCOPED_TRACE(name);
        std::mt19937 random(72);
        Stage stage({triangleSoup(random, 12, anyColor)}, name, kCentroid);
        test::NsaaStages stages(stage.input());
        const Prefilter measure = centroidMeasure(stage.filter);
        const int margin = static_cast<int>(std::ceil(measure.radius));
        const PixelBox box{-margin, -margin, kSidePx + margin, kSidePx + margin};
        const auto sampledCentroid = [&](const std::vector<Owner>& owners, int K, int x, int y, Owner owner) {
            glm::dvec2 sum(0.0);
            double total = 0.0;
            for (int j = 0; j < box.height() * K; ++j)
                for (int i = 0; i < box.width() * K; ++i) {
                    if (owners[static_cast<std::size_t>(j) * box.width() * K + i] != owner) continue;
                    const glm::dvec2 from(box.x0 + (i + 0.5) / K - (x + 0.5),
                                          box.y0 + (j + 0.5) / K - (y + 0.5));
                    if (std::max(std::fabs(from.x), std::fabs(from.y)) > measure.radius) continue;
                    const double w = evaluate(measure, from.x, from.y);
                    sum += w * from, total += w;
                }
            return sum / total;
        };
        const std::vector<Owner> coarse = PointSampler(stages.screen(), box, 16).sample(box).owner,
                                 fine = PointSampler(stages.screen(), box, 64).sample(box).owner;
        double between = 0.0, off = 0.0;
        std::size_t pairs = 0;
        for (int y = 1; y < kSidePx; y += 3)
            for (int x = 1; x < kSidePx; x += 3) {
                const WeightTile tile = stages.weigh(x, y);
                for (std::size_t e = 0; e < tile.entries.size(); ++e) {
                    if (std::fabs(toReal(tile.entries[e].weight)) < 0.05) continue;
                    const Owner owner = tile.entries[e].owner;
                    const glm::dvec2 at64 = sampledCentroid(fine, 64, x, y, owner);
                    const glm::dvec2 at16 = sampledCentroid(coarse, 16, x, y, owner) - at64;
                    ASSERT_EQ(tile.points.of(e).size(), 1u);
                    const glm::dvec2 difference = tile.points.of(e)[0] - at64;
                    between += glm::dot(at16, at16), off += glm::dot(difference, difference), ++pairs;
                }
            }
        std::printf("seed 72: %s, %zu pairs: rms %.2e px from 64 x 64 samples, which are %.2e from 16 x 16\n",
                    name, pairs, std::sqrt(off / pairs), std::sqrt(between / pairs));
        EXPECT_GT(pairs, 15u);
        EXPECT_LE(off, between);
    }
}

/// The front-most triangle at p; none where p is within 2^-40 px of an edge of any.
std::optional<Owner> frontAt(const ScreenScene& screen, glm::dvec2 p) {
    Owner best = kBackground;
    double best_depth = -1e300;
    for (const ScreenTriangle& t : screen.triangles) {
        bool inside = true;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2 a = t.p_px[k], e = t.p_px[(k + 1) % 3] - a;
            const double distance = (e.x * (p.y - a.y) - e.y * (p.x - a.x)) / glm::length(e);
            if (std::fabs(distance) < 0x1p-40) return std::nullopt;
            inside = inside && distance > 0;
        }
        const DepthPlane& z = screen.planes[t.plane];
        const glm::dvec2 from = p - screen.anchor_px;
        const double depth = z.dz_dx * from.x + z.dz_dy * from.y + z.z_anchor;
        if (inside && depth > best_depth) best = t.owner, best_depth = depth;
    }
    return best;
}

TEST(ShadingPoints, SamplesLieWhereTheOwnerIsSeen) {
    std::mt19937 random(73);
    const Geometry scenes[] = {triangleSoup(random, 40, anyColor), latticeScene()};
    for (const Geometry& geometry : scenes)
        for (const char* name : {"gaussian", "mitchell", "box"}) {
            SCOPED_TRACE(name);
            Stage stage({geometry}, name, {ShadingMode::kSamples, 6});
            test::NsaaStages stages(stage.input());
            std::size_t points = 0, full = 0, wrong = 0, undecided = 0;
            for (int y = 0; y < kSidePx; ++y)
                for (int x = 0; x < kSidePx; ++x) {
                    const WeightTile tile = stages.weigh(x, y);
                    for (std::size_t e = 0; e < tile.entries.size(); ++e) {
                        const auto offsets = tile.points.of(e);
                        ASSERT_LE(offsets.size(), 6u);
                        full += offsets.size() == 6;
                        if (offsets.size() < 2) continue;  // it may be a centroid, which may lie anywhere
                        for (const glm::dvec2& offset : offsets) {
                            // Points on edges belong to what is just right of them, then just below.
                            const glm::dvec2 p = glm::dvec2(x + 0.5, y + 0.5) + offset;
                            const auto owner = frontAt(stages.screen(), p + glm::dvec2(0x1p-34, 0x1p-38));
                            undecided += !owner;
                            if (!owner) continue;
                            ++points;
                            wrong += *owner != tile.entries[e].owner;
                            EXPECT_LE(std::max(std::fabs(offset.x), std::fabs(offset.y)),
                                      stage.filter.radius);
                        }
                    }
                }
            std::printf("seed 73: %s: %zu points, %zu undecided, %zu owners with all six\n", name, points,
                        undecided, full);
            EXPECT_EQ(wrong, 0u);
            EXPECT_GT(points, 400u);
            EXPECT_LT(undecided, points / 50);
            EXPECT_GT(full, 40u);
        }
}

TEST(ShadingPoints, HalfCoveredPixelByHand) {
    // Covers x >= 4 px; red is the distance from the film's left edge in pixels.
    Geometry geometry = test::makeGeometry({{{{0, -40, -1}, {80, 0, -1}, {0, 40, -1}}}});
    for (const glm::dvec3& p : geometry.position_world) geometry.color.push_back({p.x + 4, 0, 0, 1});
    Stage stage({geometry}, "box", kCentroid);
    stage.filter = makePrefilter("box", 1.0, {});
    test::NsaaStages stages(stage.input());
    // The sample (3.5, 4.5) sees [2.5, 4.5]: 1/4 of it is covered, around x = 4.25.
    const WeightTile tile = stages.weigh(3, 4);
    ASSERT_EQ(tile.entries.size(), 2u);
    EXPECT_EQ(tile.points.of(0)[0], glm::dvec2(0.75, 0.0));
    EXPECT_EQ(tile.points.of(1)[0], glm::dvec2(-0.25, 0.0));
    const ImageBuffer image = stage.render();
    EXPECT_NEAR(image.rgba[image.index(3, 4)].r, 0.25 * 4.25, 16 * 0x1p-53);
    EXPECT_NEAR(image.rgba[image.index(4, 4)].r, 0.75 * 4.75, 16 * 0x1p-53);
    stage.options.shading = {};
    const ImageBuffer closest = stage.render();
    EXPECT_NEAR(closest.rgba[closest.index(3, 4)].r, 0.25 * 4.0, 16 * 0x1p-53);
}

/// Linear colours: a colour at the weighted centroid is the region's exact mean. So nsaa is exact for the
/// interior of a flat triangle's gradient and its edge, and ssaa comes near.
TEST(ShadingPoints, CentroidsMakeLinearShadingExact) {
    Geometry geometry = test::makeGeometry({{{{-2.3f, -90, -1}, {90, 0, -1}, {-1.1f, 90, -1}}}});
    for (const glm::dvec3& p : geometry.position_world) geometry.color.push_back({p.x + 4, p.y + 4, 1, 1});
    Stage stage({geometry}, "gaussian", kCentroid);
    const ImageBuffer exact = stage.render();
    const auto worstOf = [&](const char* method) {
        const ImageBuffer image = stage.render(method);
        double worst = 0.0;
        for (std::size_t i = 0; i < image.rgba.size(); ++i)
            worst = std::max(worst, glm::length(glm::dvec3(image.rgba[i] - exact.rgba[i])));
        return worst;
    };
    stage.options.shading = {ShadingMode::kHit, 1};
    const double coarse = worstOf("ssaa:8"), fine = worstOf("ssaa:32");
    std::printf("ssaa:8 differs by %.1e, ssaa:32 by %.1e\n", coarse, fine);
    EXPECT_LT(fine, coarse / 2);
    stage.options.shading = {};
    EXPECT_GT(worstOf("nsaa"), 5 * fine) << "shaded at the closest point it is not exact";
}

TEST(ShadingPoints, OwnersOfAlmostNothingAreShadedAtTheClosestPoint) {
    Geometry geometry =
        test::makeGeometry({{{{0, -40, -1}, {80, 0, -1}, {0, 40, -1}}},
                            {{{-0x1p-10f, -40, -1}, {-0x1p-10f + 0x1p-31f, 0, -1}, {-0x1p-10f, 40, -1}}}});
    for (const glm::dvec3& p : geometry.position_world) geometry.color.push_back(anyColor(p));
    Stage stage({geometry}, "gaussian", kCentroid);
    test::NsaaStages stages(stage.input());
    std::size_t with = 0, without = 0;
    for (int x = 2; x < 6; ++x) {
        const WeightTile tile = stages.weigh(x, 4);
        for (std::size_t e = 0; e < tile.entries.size(); ++e) {
            const bool thin = tile.entries[e].weight < FixedWeight{1} << (kWeightBits - 32);
            EXPECT_EQ(tile.points.of(e).size(), thin ? 0u : 1u);
            (thin ? without : with) += 1;
        }
    }
    EXPECT_GT(with, 3u);
    EXPECT_GT(without, 0u);
}

class ShadingModes : public testing::TestWithParam<ShadingChoice> {};

TEST_P(ShadingModes, ThreadsCropsAndWholePixelsDoNotShow) {
    for (const auto& [name, alpha_mode] :
         {std::pair("gaussian", AlphaMode::kOpaque), std::pair("mitchell", AlphaMode::kOpaque),
          std::pair("gaussian", AlphaMode::kBlend)}) {
        SCOPED_TRACE(name);
        std::mt19937 random(74);
        Stage stage({triangleSoup(random, 40, anyColor)}, name, GetParam());
        stage.scene.materials[0].alpha_mode = alpha_mode;
        stage.scene.materials[0].base_color.a = 0.5;
        const ImageBuffer whole = stage.render();
        for (const int threads : {1, 3}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
            EXPECT_EQ(stage.render().rgba, whole.rgba);
        }
        stage.film.debug_offset_px = {16384, -8191};
        EXPECT_EQ(stage.render().rgba, whole.rgba);
        stage.film.debug_offset_px = {0, 0};
        stage.film.crop = {2, 3, 7, 6};
        const ImageBuffer part = stage.render();
        for (int y = 3; y < 6; ++y)
            for (int x = 2; x < 7; ++x)
                EXPECT_EQ(part.rgba[part.index(x, y)], whole.rgba[whole.index(x, y)]) << x << " " << y;
        stage.film.crop = {0, 0, kSidePx, kSidePx};
        stage.options.shading = {};
        EXPECT_NE(stage.render().rgba, whole.rgba) << "the mode had to matter";
    }
}

INSTANTIATE_TEST_SUITE_P(All, ShadingModes,
                         testing::Values(kCentroid, ShadingChoice{ShadingMode::kSamples, 3}));

TEST(ShadingPoints, HitIsTheClosestPointWithANote) {
    std::mt19937 random(75);
    Stage stage({triangleSoup(random, 10, anyColor)}, "box", {ShadingMode::kHit, 1});
    const MethodResult hit = runMethod(parseMethod("nsaa"), stage.input());
    ASSERT_EQ(hit.notes.size(), 1u);
    stage.options.shading = {};
    EXPECT_EQ(stage.render().rgba, hit.image.rgba);
}

}  // namespace
}  // namespace edgewise
