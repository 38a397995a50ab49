// The methods none and ssaa, the method grammar, and the weights of samples.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "pipeline/error.h"
#include "pipeline/methods/method.h"
#include "pipeline/methods/point_samples.h"
#include "pipeline/methods/sample_weights.h"
#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

FixedWeight sumOf(const SampleWeights& weights) {
    FixedWeight sum = 0;
    for (const auto& row : weights.rows) sum += row.of(0, row.size());
    return sum;
}

TEST(SampleWeights, SumToExactlyOne) {
    for (const char* name :
         {"box", "disk", "tent", "cone", "gaussian", "gaussian-separable", "mitchell", "lanczos"})
        for (const int per_side : {1, 2, 3, 4, 8}) {
            const Prefilter filter = makePrefilter(name, std::nullopt, std::nullopt);
            EXPECT_EQ(sumOf(SampleWeights(filter, per_side)), FixedWeight(1) << kWeightBits)
                << name << per_side;
        }
}

TEST(SampleWeights, BoxIsUniform) {
    const SampleWeights weights(makePrefilter("box", std::nullopt, std::nullopt), 4);
    EXPECT_EQ(weights.margin_px, 0);
    for (const auto& row : weights.rows)
        for (int i = 0; i < 4; ++i) EXPECT_EQ(row.of(i, i + 1), FixedWeight(1) << (kWeightBits - 4));
}

TEST(SampleWeights, RefusesASupportWithoutSamples) {
    EXPECT_THROW(SampleWeights(makePrefilter("box", 0.01, std::nullopt), 2), InputError);
    EXPECT_THROW(SampleWeights(makePrefilter("box", 4097.0, std::nullopt), 1), FailureError);
}

/// A flat surface whose red is x and whose green is y of the film, in pixels.
Scene gradient(int side_px) {
    const float far = 4.0f;
    Geometry geometry =
        test::makeGeometry({{glm::vec3(-far, -far, -1), glm::vec3(far, -far, -1), glm::vec3(far, far, -1)},
                            {glm::vec3(-far, -far, -1), glm::vec3(far, far, -1), glm::vec3(-far, far, -1)}});
    for (const glm::vec3& p : geometry.position_file)
        geometry.color.push_back({(p.x + 1) / 2 * side_px, (1 - p.y) / 2 * side_px, 0, 1});
    return test::makeScene({geometry});
}

TEST(Ssaa, AFewOfManySamplesAreSpreadOverThePixel) {
    constexpr int kSidePx = 16;
    const Scene scene = gradient(kSidePx);
    const ResolvedCamera camera = test::makeOrthographic(1.0);
    const Film film = test::makeFilm(kSidePx, kSidePx);
    const Prefilter box = makePrefilter("box", {}, {});
    for (const int per_side : {4, 8, 16})
        for (const int count : {4, 8, 16}) {
            RenderOptions options;
            options.shading = {ShadingMode::kSamples, count};
            Progress progress;
            const MethodResult result = runMethod(parseMethod("ssaa:" + std::to_string(per_side)),
                                                  {scene, camera, film, box, options, progress});
            double squares = 0.0;
            for (int y = 0; y < kSidePx; ++y)
                for (int x = 0; x < kSidePx; ++x) {
                    const glm::dvec4 at = result.image.rgba[result.image.index(x, y)];
                    squares += std::pow(at.r - (x + 0.5), 2) + std::pow(at.g - (y + 0.5), 2);
                }
            // The mean of N independent points strays by 1/sqrt(12 N) px along each axis: spread ones by
            // less.
            const double strays = std::sqrt(squares / (2.0 * kSidePx * kSidePx));
            EXPECT_LT(strays, 1.0 / std::sqrt(12.0 * count)) << "ssaa:" << per_side << " samples:" << count;
        }
}

TEST(Methods, GrammarAndItsErrors) {
    const MethodSpec spec = parseMethod("ssaa:4,device=vulkan");
    EXPECT_EQ(spec.name, "ssaa");
    EXPECT_EQ(spec.number, 4);
    EXPECT_EQ(spec.parameter("device"), "vulkan");
    EXPECT_EQ(spec.typed, "ssaa:4,device=vulkan");
    EXPECT_EQ(parseMethod("none").name, "none");
    EXPECT_EQ(parseMethod("none+ssaa:2").composed.at(0).number, 2);
    for (const char* wrong :
         {"", "ssaa", "ssaa:0", "ssaa:", "ssaa:4x", "ssaa:4,4", "ssaa:99999999999", "none:3", "magic",
          "ssaa:4,device=abacus", "ssaa:4,speed=9", "none:device=cpu,device=cpu", "none+"})
        EXPECT_THROW(parseMethod(wrong), InputError) << wrong;
}

MethodResult render(const Scene& scene, const Film& film, const char* method, const char* filter,
                    RenderOptions options = {}) {
    const Prefilter kernel = makePrefilter(filter, std::nullopt, std::nullopt);
    const ResolvedCamera camera = test::makePerspective();
    Progress progress;
    return runMethod(parseMethod(method), {scene, camera, film, kernel, options, progress});
}

Scene randomScene(int count) {
    std::mt19937 random(53);
    std::uniform_real_distribution<float> side(-3, 3), depth(-4, 1), value(0, 1);
    std::vector<test::Corners> triangles(count);
    for (auto& t : triangles)
        for (auto& p : t) p = {side(random), side(random), depth(random)};
    Geometry geometry = test::makeGeometry(triangles);
    for (std::size_t i = 0; i < geometry.position_world.size(); ++i)
        geometry.color.push_back({value(random), value(random), value(random), 1});
    return test::makeScene({geometry});
}

TEST(Ssaa, HalfPlaneByHand) {
    // A white wall over the left half of the screen's first five columns and a half: x_px < 5.5.
    const float x = 2 * 5.5f / 16 - 1;
    const Scene scene = test::makeScene({test::makeGeometry(
        {{{{-9, -9, -1}, {x, -9, -1}, {x, 9, -1}}}, {{{-9, -9, -1}, {x, 9, -1}, {-9, 9, -1}}}})});
    RenderOptions options;
    options.background = {0, 0, 1};
    const MethodResult result = render(scene, test::makeFilm(16, 16), "ssaa:4", "box", options);
    for (int column = 0; column < 16; ++column) {
        const double cover = column < 5 ? 1.0 : (column == 5 ? 0.5 : 0.0);
        const glm::dvec4 got = result.image.rgba[result.image.index(column, 7)];
        EXPECT_EQ(got, glm::dvec4(cover, cover, 1, cover)) << column;
        EXPECT_EQ(result.image.edge[result.image.index(column, 7)], column == 5 ? 1.0f : 0.0f);
    }
}

TEST(Ssaa, OneSampleAPixelIsNone) {
    const Scene scene = randomScene(60);
    RenderOptions options;
    for (const ShadingMode mode :
         {ShadingMode::kClosest, ShadingMode::kHit, ShadingMode::kCentroid, ShadingMode::kSamples}) {
        options.shading = {mode, 3};
        const auto one = render(scene, test::makeFilm(48, 40), "ssaa:1", "box", options),
                   none = render(scene, test::makeFilm(48, 40), "none", "box");
        EXPECT_EQ(one.image.rgba, none.image.rgba);
    }
}

TEST(Ssaa, WholePixelsMoveThePicture) {
    const Scene scene = randomScene(100);
    Film film = test::makeFilm(48, 48);
    film.shift_px = {0.25, 0.4};
    const auto plain = render(scene, film, "ssaa:3", "gaussian");
    film.debug_offset_px = {5, -7};
    const auto moved = render(scene, film, "ssaa:3", "gaussian");
    for (int y = 0; y < 48 - 7; ++y)
        for (int x = 5; x < 48; ++x)
            ASSERT_EQ(moved.image.rgba[moved.image.index(x, y)],
                      plain.image.rgba[plain.image.index(x - 5, y + 7)])
                << x << " " << y;
}

TEST(Ssaa, CropThreadsAndMemoryDoNotShow) {
    const Scene scene = randomScene(200);
    Film film = test::makeFilm(64, 48);
    const auto whole = render(scene, film, "ssaa:3", "gaussian");
    film.crop = {11, 7, 53, 40};
    RenderOptions options;
    options.threads = 1;
    options.memory_mib = 0;  // a row of pixels at a time
    const auto part = render(scene, film, "ssaa:3", "gaussian", options);
    for (int y = film.crop.y0; y < film.crop.y1; ++y)
        for (int x = film.crop.x0; x < film.crop.x1; ++x) {
            ASSERT_EQ(part.image.rgba[part.image.index(x, y)], whole.image.rgba[whole.image.index(x, y)]);
            ASSERT_EQ(part.image.edge[part.image.index(x, y)], whole.image.edge[whole.image.index(x, y)]);
        }
}

/// A pixel summed sample by sample with its colour where it lands. The bound: 64 + 256 terms of size up to 1,
/// u each.
TEST(Ssaa, HitMatchesAPlainSum) {
    const Scene scene = randomScene(80);
    const Film film = test::makeFilm(24, 24);
    RenderOptions options;
    options.shading.mode = ShadingMode::kHit;
    const auto fine = render(scene, test::makeFilm(96, 96), "none", "box",
                             options);  // its pixels are the samples of ssaa:4
    const auto result = render(scene, film, "ssaa:4", "tent", options);
    const Prefilter tent = makePrefilter("tent", std::nullopt, std::nullopt);
    for (int y = 2; y < 22; ++y)
        for (int x = 2; x < 22; ++x) {
            glm::dvec4 sum(0.0);
            double weights = 0.0;
            for (int j = 4 * y - 4; j < 4 * y + 8; ++j)
                for (int i = 4 * x - 4; i < 4 * x + 8; ++i) {
                    const double w = evaluate(tent, (i + 0.5) / 4 - x - 0.5, (j + 0.5) / 4 - y - 0.5);
                    sum += fine.image.rgba[fine.image.index(i, j)] * w;
                    weights += w;
                }
            const glm::dvec4 got = result.image.rgba[result.image.index(x, y)];
            for (int k = 0; k < 4; ++k) ASSERT_NEAR(got[k], sum[k] / weights, 320 * 0x1p-53) << x << " " << y;
        }
}

TEST(Ssaa, StopsWhenCancelled) {
    struct Stop : Progress {
        bool cancelled() override { return true; }
    } stop;
    const Scene scene = randomScene(5);
    const Film film = test::makeFilm(8, 8);
    const Prefilter box = makePrefilter("box", std::nullopt, std::nullopt);
    const RenderOptions options;
    const ResolvedCamera camera = test::makePerspective();
    EXPECT_THROW(runMethod(parseMethod("ssaa:2"), {scene, camera, film, box, options, stop}), Interrupted);
}

}  // namespace
}  // namespace edgewise
