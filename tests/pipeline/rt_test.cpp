// The method rt: rays against exact samples, pixels against a plain sum and against nsaa.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "pipeline/error.h"
#include "pipeline/methods/method.h"
#include "pipeline/methods/pattern_weights.h"
#include "pipeline/methods/ray_scene.h"
#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

MethodResult render(const Scene& scene, const Film& film, const std::string& method, const Prefilter& filter,
                    const RenderOptions& options = {},
                    const ResolvedCamera& camera = test::makePerspective()) {
    Progress progress;
    return runMethod(parseMethod(method), {scene, camera, film, filter, options, progress});
}

Prefilter filterOf(const char* name) {
    return makePrefilter(name, std::nullopt, std::nullopt);
}

/// Triangles of one colour each that pierce each other, every eighth a large one that may reach behind the
/// camera; every `pane`-th is seen through.
Scene randomScene(int count, unsigned seed, int pane = 0) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1), value(0, 1);
    std::vector<Geometry> geometry;
    std::vector<glm::dvec4> colors;
    for (int i = 0; i < count; ++i) {
        const bool large = i % 8 == 3;
        const glm::vec3 centre(2.5f * unit(random), 2.5f * unit(random), -2.5f + unit(random));
        test::Corners t;
        for (auto& p : t)
            p = centre + (large ? 3.0f : 0.9f) * glm::vec3(unit(random), unit(random), unit(random));
        geometry.push_back(test::makeGeometry({t}));
        colors.emplace_back(value(random), value(random), value(random), 0.25 + 0.5 * value(random));
    }
    Scene scene = test::makeScene(std::move(geometry));
    scene.materials.resize(count, scene.materials[0]);
    for (int i = 0; i < count; ++i) {
        scene.geometry[i].material = std::uint32_t(i);
        scene.materials[i].base_color = colors[i];
        if (pane > 0 && i % pane == 0) scene.materials[i].alpha_mode = AlphaMode::kBlend;
    }
    return scene;
}

using Layers = std::vector<Owner>;

Layers layersOf(const SampledOwners& sampled, std::size_t i) {
    const auto layers = sampled.stacks.layersOf(sampled.owner[i]);
    return {layers.begin(), layers.end()};
}

/// What exact samples see at a sample and around it: at distances 2^-12 px in eight directions, which is more
/// than float32 moves an edge or the line where two triangles pierce at a moderate angle: 2^-24 of 32 px some
/// ten times.
std::vector<std::set<Layers>> exactlyAround(const PointSampler& exact, const PixelBox& box) {
    std::vector<std::set<Layers>> seen;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            const SampledOwners at = exact.sample(box, glm::dvec2(i, j) * 0x1p-12);
            seen.resize(at.owner.size());
            for (std::size_t s = 0; s < seen.size(); ++s) seen[s].insert(layersOf(at, s));
        }
    return seen;
}

void expectOwnersOfExactSamples(const Scene& scene, const ResolvedCamera& camera, const char* what) {
    constexpr int kSidePx = 48, kPerSide = 4;
    Film film = test::makeFilm(kSidePx, kSidePx);
    film.shift_px = {0.123, 0.456};
    const ScreenScene screen = project(scene, camera, film);
    const PixelBox box{-2, -2, kSidePx + 2, kSidePx + 2};
    const PointSampler exact(screen, box, kPerSide);
    const RayScene rays(screen, film, camera.camera.perspective, 2);
    const SampledOwners got = rays.trace(box, {kPerSide * kPerSide, latticePattern(kPerSide).at_px, 0}),
                        want = exact.sample(box);
    const auto around = exactlyAround(exact, box);
    ASSERT_EQ(got.owner.size(), want.owner.size());
    std::set<Layers> met;
    int differ = 0, unexplained = 0;
    const int columns = box.width() * kPerSide;
    for (int i = 0; i < static_cast<int>(want.owner.size()); ++i) {
        const int x = i % columns, y = i / columns;
        const int pixel = y / kPerSide * box.width() + x / kPerSide;
        const Layers one =
            layersOf(got, pixel * kPerSide * kPerSide + y % kPerSide * kPerSide + x % kPerSide);
        met.insert(one);
        differ += one != layersOf(want, i);
        unexplained += !around[i].contains(one);
    }
    fmt::print("{}: {} of {} samples differ, {} owners\n", what, differ, want.owner.size(), met.size());
    EXPECT_EQ(unexplained, 0) << what;
    EXPECT_LT(differ, want.owner.size() / 1000) << what;
    EXPECT_GT(met.size(), 15u) << what;
    const auto deep = [](const Layers& layers) { return layers.size() > 2; };
    EXPECT_EQ(std::ranges::any_of(met, deep), !screen.see_through.empty()) << what;
}

TEST(Rt, RaysSeeWhatExactSamplesSee) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        expectOwnersOfExactSamples(randomScene(80, seed), test::makePerspective(), "perspective");
        expectOwnersOfExactSamples(randomScene(80, seed), test::makePerspective(0x1p-20), "close");
        expectOwnersOfExactSamples(randomScene(80, seed), test::makeOrthographic(2.0), "orthographic");
        expectOwnersOfExactSamples(randomScene(90, seed, 2), test::makePerspective(), "panes");
        expectOwnersOfExactSamples(randomScene(90, seed, 2), test::makeOrthographic(2.0),
                                   "panes, orthographic");
    }
}

/// Walls of one plane each: two triangles that cover a square and, before and after them in the order of the
/// index, copies of themselves and smaller ones that overlap them and each other.
Scene decalScene(unsigned seed, int pane = 0) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<Geometry> geometry;
    for (int wall = 0; wall < 4; ++wall) {
        const glm::vec3 centre(1.2f * unit(random), 1.2f * unit(random), -3.0f + unit(random));
        const auto at = [&](float x, float y) {  // of a lattice, so that all are exactly coplanar
            return centre + glm::vec3(std::round(x * 64) / 64, std::round(y * 64) / 64, 0.0f);
        };
        const test::Corners half{at(-1, -1), at(1, -1), at(1, 1)}, other{at(-1, -1), at(1, 1), at(-1, 1)};
        std::vector<test::Corners> triangles;
        const auto addDecals = [&] {
            for (int i = 0; i < 6; ++i)
                triangles.push_back({at(unit(random), unit(random)), at(unit(random), unit(random)),
                                     at(unit(random), unit(random))});
        };
        addDecals();
        triangles.insert(triangles.end(), {half, other, half, other});
        addDecals();
        geometry.push_back(test::makeGeometry(triangles));
    }
    Scene scene = test::makeScene(std::move(geometry));
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].alpha_mode = AlphaMode::kBlend;
    scene.materials[1].base_color.a = 0.5;
    if (pane > 0)
        for (std::size_t i = 0; i < scene.geometry.size(); i += pane) scene.geometry[i].material = 1;
    return scene;
}

TEST(Rt, OfCoplanarTrianglesTheLowerIndexIsSeen) {
    for (const unsigned seed : {11u, 12u, 13u}) {
        expectOwnersOfExactSamples(decalScene(seed), test::makePerspective(), "decals");
        expectOwnersOfExactSamples(decalScene(seed), test::makeOrthographic(2.0), "decals, orthographic");
        expectOwnersOfExactSamples(decalScene(seed, 2), test::makePerspective(), "decals and panes");
    }
}

/// Only triangles that others of a lower index overlap are asked about: a wall of many is not.
TEST(Rt, NeighboursInAPlaneAreNoTies) {
    std::vector<test::Corners> wall;
    for (int y = -8; y < 8; ++y)
        for (int x = -8; x < 8; ++x) {
            const float l = x / 8.0f, r = (x + 1) / 8.0f, b = y / 8.0f, t = (y + 1) / 8.0f;
            wall.push_back({{{l, b, -2}, {r, b, -2}, {r, t, -2}}});
            wall.push_back({{{l, b, -2}, {r, t, -2}, {l, t, -2}}});
        }
    const Film film = test::makeFilm(32, 32);
    const auto tiesOf = [&](const std::vector<test::Corners>& triangles) {
        const Scene scene = test::makeScene({test::makeGeometry(triangles)});
        const ScreenScene screen = project(scene, test::makePerspective(), film);
        return CoplanarTies(screen).any();
    };
    EXPECT_FALSE(tiesOf(wall));
    wall.push_back(wall[100]);
    EXPECT_TRUE(tiesOf(wall));
}

/// Far surfaces keep apart though the nearest depth is 2^20 times theirs.
TEST(Rt, DepthIsRelative) {
    constexpr float kFar = 1.0e4f;
    std::vector<test::Corners> triangles{{{{0, 0, -0.01f}, {1e-4f, 0, -0.01f}, {0, 1e-4f, -0.01f}}}};
    for (const float depth : {kFar * 1.001f, kFar})
        triangles.push_back(
            {{{-9 * kFar, -9 * kFar, -depth}, {9 * kFar, -9 * kFar, -depth}, {0, 9 * kFar, -depth}}});
    const Scene scene = test::makeScene({test::makeGeometry(triangles)});
    const Film film = test::makeFilm(32, 32);
    const ScreenScene screen = project(scene, test::makePerspective(0.005), film);
    const SampledOwners seen = RayScene(screen, film, true, 0).trace(film.crop, sobolPatterns(8, 4, 0));
    std::size_t nearer = 0;
    for (const Owner owner : seen.owner) {
        EXPECT_NE(owner, 1u);
        nearer += owner == 2;
    }
    EXPECT_GT(nearer, seen.owner.size() / 2);
}

/// All pixels summed sample by sample from the kernel's definition. The bound: 49 x 8 weights rounded to
/// 2^-60 of the table's unit are lost in a double's u for each of as many terms.
TEST(Rt, PixelsArePlainSums) {
    constexpr int kSamples = 8;
    const Scene scene = randomScene(60, 5);
    const Film film = test::makeFilm(20, 20);
    const ScreenScene screen = project(scene, test::makePerspective(), film);
    RenderOptions options;
    options.background = {0.1, 0.2, 0.3};
    for (const char* name : {"box", "tent", "gaussian", "mitchell", "lanczos"}) {
        const Prefilter filter = filterOf(name);
        const int margin = PatternWeights::marginPx(filter);
        const PixelPatterns patterns = sobolPatterns(kSamples, patternCount(filter, kSamples), options.seed);
        const PixelBox box{-margin, -margin, 20 + margin, 20 + margin};
        const SampledOwners sampled = RayScene(screen, film, true, margin).trace(box, patterns);
        const MethodResult result = render(scene, film, "rt:8", filter, options);
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 20; ++x) {
                glm::dvec3 sum(0.0);
                double weights = 0.0;
                for (std::size_t i = 0; i < sampled.owner.size(); ++i) {
                    const int px = int(i / kSamples) % box.width() - margin,
                              py = int(i / kSamples) / box.width() - margin;
                    const glm::dvec2 at =
                        glm::dvec2(px, py) + patterns.pattern(patterns.patternOf(px, py))[i % kSamples];
                    const double w = evaluate(filter, at.x - x - 0.5, at.y - y - 0.5);
                    const Owner owner = sampled.owner[i];
                    sum += w * (owner == kBackground ? options.background
                                                     : glm::dvec3(scene.materials[owner].base_color));
                    weights += w;
                }
                const glm::dvec4 got = result.image.rgba[result.image.index(x, y)];
                for (int k = 0; k < 3; ++k)
                    ASSERT_NEAR(got[k], sum[k] / weights, 2000 * 0x1p-53) << name << " " << x << " " << y;
            }
    }
}

TEST(Rt, WhereFlatColoursAreShadedDoesNotShow) {
    const Scene scene = randomScene(30, 6, 3);
    const Film film = test::makeFilm(24, 24);
    RenderOptions options;
    const MethodResult closest = render(scene, film, "rt:16", filterOf("mitchell"), options);
    for (const ShadingMode mode : {ShadingMode::kHit, ShadingMode::kCentroid, ShadingMode::kSamples}) {
        options.shading = {mode, 4};
        const MethodResult result = render(scene, film, "rt:16", filterOf("mitchell"), options);
        for (std::size_t i = 0; i < result.image.rgba.size(); ++i) {
            for (int k = 0; k < 4; ++k)
                ASSERT_NEAR(result.image.rgba[i][k], closest.image.rgba[i][k], 2000 * 0x1p-53);
            ASSERT_EQ(result.image.edge[i], closest.image.edge[i]);
        }
    }
}

TEST(Rt, CropThreadsAndMemoryDoNotShow) {
    const Scene scene = randomScene(120, 7, 4);
    for (const char* method : {"rt:1", "rt:5", "rt:16"}) {
        Film film = test::makeFilm(64, 48);
        RenderOptions options;
        options.threads = 2;
        const auto whole = render(scene, film, method, filterOf("gaussian"), options);
        film.crop = {11, 7, 53, 40};
        options.threads = 1;
        options.memory_mib = 0;  // a row of pixels at a time
        const auto part = render(scene, film, method, filterOf("gaussian"), options);
        for (int y = film.crop.y0; y < film.crop.y1; ++y)
            for (int x = film.crop.x0; x < film.crop.x1; ++x) {
                const std::size_t p = part.image.index(x, y), w = whole.image.index(x, y);
                ASSERT_EQ(part.image.rgba[p], whole.image.rgba[w]) << method << " " << x << " " << y;
                ASSERT_EQ(part.image.edge[p], whole.image.edge[w]);
            }
    }
}

/// Signed errors of the pixels' red, green and blue against nsaa.
std::vector<double> errorsOf(const Scene& scene, const Film& film, const Prefilter& filter, int samples,
                             std::uint64_t seed, const ImageBuffer& truth, bool edges_alone = false) {
    RenderOptions options;
    options.seed = seed;
    const MethodResult result = render(scene, film, fmt::format("rt:{}", samples), filter, options);
    std::vector<double> errors;
    for (std::size_t i = 0; i < truth.rgba.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (!edges_alone || truth.edge[i] != 0.0f)
                errors.push_back(result.image.rgba[i][k] - truth.rgba[i][k]);
    return errors;
}

double meanOf(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values) sum += v;
    return sum / double(values.size());
}

double rmsOf(const std::vector<double>& values) {
    double squares = 0.0;
    for (const double v : values) squares += v * v;
    return std::sqrt(squares / double(values.size()));
}

/// Each seed gives one mean over the picture; their mean is 0 within 4.07 standard errors, Student's 99.9 %
/// for 15 degrees of freedom. A pixel that one edge of contrast 1
/// crosses errs by less than N^-3/4.
TEST(Rt, AgreesWithNsaaWithoutBias) {
    constexpr int kSeeds = 16;
    const Scene scene = randomScene(40, 8);
    const Film film = test::makeFilm(24, 24);
    for (const char* name : {"box", "gaussian", "mitchell"}) {
        const Prefilter filter = filterOf(name);
        const MethodResult truth = render(scene, film, "nsaa", filter);
        std::vector<double> means;
        double worst = 0.0, rms = 0.0;
        for (int seed = 0; seed < kSeeds; ++seed) {
            const auto errors = errorsOf(scene, film, filter, 1024, seed, truth.image);
            means.push_back(meanOf(errors));
            rms += rmsOf(errors) / kSeeds;
            for (const double e : errors) worst = std::max(worst, std::fabs(e));
        }
        const double bias = meanOf(means);
        std::vector<double> spread;
        for (const double m : means) spread.push_back(m - bias);
        const double standard_error = rmsOf(spread) / std::sqrt(kSeeds - 1.0);
        fmt::print("{}: bias {:.2e} +- {:.2e}, rms {:.2e}, max {:.2e}\n", name, bias, standard_error, rms,
                   worst);
        EXPECT_LT(std::fabs(bias), 4.07 * standard_error) << name;
        EXPECT_LT(rms, std::pow(1024.0, -0.75)) << name;
        EXPECT_GT(rms, 0.0);
    }
}

/// One edge that is parallel to no axis: of the N cells of a pixel that hold one sample each about N^1/2 are
/// crossed, and each errs by a coin of 1/N: N^-3/4. Rms over n = 320 pixels and seeds is known to
/// 1/sqrt(2 n), so the slope over ln N from 2.8 to 6.9 to about 0.01; 0.08 leaves room for the power itself,
/// which holds for large N.
TEST(Rt, ErrorFallsAsTheThreeQuartersPower) {
    const Scene scene =
        test::makeScene({test::makeGeometry({{{{-9, -9, -1}, {0.37f, -9, -1}, {-0.21f, 9, -1}}}})});
    const Film film = test::makeFilm(32, 32);
    const Prefilter box = filterOf("box");
    const MethodResult truth = render(scene, film, "nsaa", box);
    std::vector<glm::dvec2> points;
    for (const int samples : {16, 32, 64, 128, 256, 512, 1024}) {
        std::vector<double> all;
        for (int seed = 0; seed < 10; ++seed)
            for (const double e : errorsOf(scene, film, box, samples, seed, truth.image, true))
                all.push_back(e);
        ASSERT_GT(all.size(), 3u * 10u * 32u);
        points.emplace_back(std::log(samples), std::log(rmsOf(all)));
        fmt::print("N {}: rms {:.3e}\n", samples, rmsOf(all));
    }
    glm::dvec2 mean(0.0);
    for (const glm::dvec2& p : points) mean += p / double(points.size());
    double xy = 0.0, xx = 0.0;
    for (const glm::dvec2& p : points)
        xy += (p.x - mean.x) * (p.y - mean.y), xx += (p.x - mean.x) * (p.x - mean.x);
    fmt::print("slope {:.3f}\n", xy / xx);
    EXPECT_NEAR(xy / xx, -0.75, 0.08);
}

TEST(Rt, RefusesWhatItCannotFilter) {
    const Scene scene = randomScene(3, 9);
    const Film film = test::makeFilm(16, 16);
    EXPECT_THROW(render(scene, film, "rt:1", makePrefilter("disk", 0.01, std::nullopt)), InputError);
    EXPECT_THROW(render(scene, film, "rt:1024", makePrefilter("box", 64.0, std::nullopt)), FailureError);
    EXPECT_THROW(parseMethod("rt"), InputError);
    EXPECT_THROW(parseMethod("rt:0"), InputError);
}

TEST(Rt, AnEmptySceneIsBackground) {
    RenderOptions options;
    options.background = {0, 0.5, 1};
    const MethodResult result =
        render(test::makeScene({}), test::makeFilm(9, 7), "rt:3", filterOf("gaussian"), options);
    for (const glm::dvec4& pixel : result.image.rgba) EXPECT_EQ(pixel, glm::dvec4(0, 0.5, 1, 0));
}

TEST(Rt, StopsWhenCancelled) {
    struct Stop : Progress {
        bool cancelled() override { return true; }
    } stop;
    const Scene scene = randomScene(5, 10);
    const Film film = test::makeFilm(8, 8);
    const Prefilter box = filterOf("box");
    const RenderOptions options;
    const ResolvedCamera camera = test::makePerspective();
    EXPECT_THROW(runMethod(parseMethod("rt:2"), {scene, camera, film, box, options, stop}), Interrupted);
}

}  // namespace
}  // namespace edgewise
