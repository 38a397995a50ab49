// The method csaa: where its samples lie, and which of them count.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "pipeline/error.h"
#include "pipeline/judge/metrics.h"
#include "pipeline/methods/csaa.h"
#include "pipeline/methods/sampled_frame.h"
#include "tests/pipeline/shipped_picture.h"
#include "tests/pipeline/standard_locations.h"
#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

constexpr int kSamples = kColorSamples + kCoverageSamples;

/// Of the unit square, x cos + y sin < d.
double halfPlaneArea(double cosine, double sine, double d) {
    const double c = std::fabs(cosine), s = std::fabs(sine), from = d - std::min(0.0, cosine);
    const auto wedge = [](double t) { return t > 0.0 ? t * t : 0.0; };
    return (wedge(from) - wedge(from - c) - wedge(from - s) + wedge(from - c - s)) / (2 * c * s);
}

struct HalfPlaneError {
    double rms, max;
};

/// Of the share of samples inside against the area, over 64 directions x 64 offsets.
HalfPlaneError halfPlaneError(const std::vector<glm::dvec2>& at_px) {
    constexpr int kSteps = 64;
    double sum = 0.0, max = 0.0;
    for (int k = 0; k < kSteps; ++k) {
        const double angle = std::numbers::pi * (k + 0.5) / kSteps, c = std::cos(angle), s = std::sin(angle);
        for (int j = 0; j < kSteps; ++j) {
            const double d = std::min(0.0, c) + (j + 0.5) / kSteps * (std::fabs(c) + s);
            const auto inside = std::ranges::count_if(at_px, [&](auto p) { return p.x * c + p.y * s < d; });
            const double error = double(inside) / double(at_px.size()) - halfPlaneArea(c, s, d);
            sum += error * error, max = std::max(max, std::fabs(error));
        }
    }
    return {std::sqrt(sum) / kSteps, max};
}

TEST(Csaa, SamplesTakeEveryColumnAndRowOnce) {
    const SamplePattern pattern = coverageSampledPattern();
    ASSERT_EQ(pattern.size(), kSamples);
    ASSERT_EQ(pattern.at_px.size(), std::size_t(kSamples));
    const std::vector<glm::dvec2> colour(pattern.at_px.begin(), pattern.at_px.begin() + kColorSamples);
    EXPECT_EQ(colour, standardPattern(kColorSamples).at_px);
    std::set<int> columns, rows;
    for (const glm::dvec2& p : pattern.at_px) {
        EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
        columns.insert(int(p.x * kSamples)), rows.insert(int(p.y * kSamples));
    }
    EXPECT_EQ(columns.size(), std::size_t(kSamples));
    EXPECT_EQ(rows.size(), std::size_t(kSamples));
}

/// The errors that csaa.cpp says it was chosen by.
TEST(Csaa, SamplesFollowHalfPlanes) {
    const HalfPlaneError all = halfPlaneError(coverageSampledPattern().at_px),
                         eight = halfPlaneError(standardPattern(kColorSamples).at_px);
    fmt::print("32: rms {:.5f}, max {:.5f}; 8: rms {:.5f}, max {:.5f}\n", all.rms, all.max, eight.rms,
               eight.max);
    EXPECT_NEAR(all.rms, 0.0190, 5e-5);
    EXPECT_NEAR(all.max, 0.073, 5e-4);
    EXPECT_NEAR(eight.rms, 0.057, 5e-4);
    EXPECT_NEAR(eight.max, 0.222, 5e-4);
}

TEST(Csaa, OtherCountsAreRefused) {
    for (const char* wrong : {"csaa", "csaa:0", "csaa:8", "csaa:16", "csaa:33"})
        EXPECT_THROW(parseMethod(wrong), InputError) << wrong;
    EXPECT_FALSE(takesFilter(parseMethod("csaa:32")));
}

TEST(Csaa, ForgetsWhatNoColorSampleSees) {
    std::vector<Owner> owner(2 * kSamples, 7);
    owner[3] = kBackground, owner[20] = kBackground;  // stored, so known
    owner[9] = 5, owner[31] = 6;
    owner[kSamples + 20] = kBackground;  // the other pixel stores that: it is not this one's
    std::vector<Owner> expected = owner;
    expected[9] = expected[31] = expected[kSamples + 20] = kUnknown;
    EXPECT_EQ(forgetUnstored(owner), 3u);
    EXPECT_EQ(owner, expected);
}

MethodResult render(const Scene& scene, const Film& film, const std::string& method,
                    const RenderOptions& options) {
    Progress progress;
    return runMethod(parseMethod(method), {scene, test::makeOrthographic(1.0), film,
                                           makePrefilter("gaussian", {}, {}), options, progress});
}

constexpr int kSidePx = 16, kColumn = 5;

RenderOptions onPureBlue() {
    RenderOptions options;
    options.background = {0, 0, 1};
    return options;
}

/// What lies between two 32nds of the column of pixels, from top to bottom; on the film it is one triangle,
/// up to 2^-12 of its width.
Geometry strip(double from, double to, float z) {
    const auto at = [](double x) { return static_cast<float>(2 * (kColumn + x / 32) / kSidePx - 1); };
    const float a = at(from), b = at(to), low = -2, high = 16000;
    return test::makeGeometry(
        {{{{a, low, z}, {b, low, z}, {b, high, z}}}, {{{a, low, z}, {b, high, z}, {a, high, z}}}});
}
constexpr double kFarLeft = -1000.0;

/// A column of a pixel holds a sample and the standard locations are on the left of columns 2, 6, ..., 30: an
/// edge at e + 1/4 has e + 1 columns on its left, or e where the last one's sample lies in its centre. Beyond
/// the first and the last colour sample nothing is seen.
TEST(Csaa, HalfPlaneByHand) {
    std::set<double> met;
    for (int e = 0; e < 32; ++e) {
        const MethodResult result = render(test::makeScene({strip(kFarLeft, e + 0.25, -1)}),
                                           test::makeFilm(kSidePx, kSidePx), "csaa:32", onPureBlue());
        const int left = e % 4 == 2 ? e + 1 : e;
        const double cover = e < 2 ? 0.0 : e >= 30 ? 1.0 : left / 32.0;
        const std::size_t i = result.image.index(kColumn, 7);
        EXPECT_EQ(result.image.rgba[i], glm::dvec4(cover, cover, 1, cover)) << e;
        EXPECT_EQ(result.image.edge[i], cover > 0.0 && cover < 1.0 ? 1.0f : 0.0f);
        met.insert(cover);
    }
    EXPECT_GT(met.size(), 20u);
}

/// Between two columns of colour samples three columns of coverage samples see a sliver, and forget it.
TEST(Csaa, ASliverBetweenColorSamplesIsNotSeen) {
    const auto alpha = [](double from, double to, std::uint64_t unknown) {
        const MethodResult result = render(test::makeScene({strip(from, to, -1)}),
                                           test::makeFilm(kSidePx, kSidePx), "csaa:32", onPureBlue());
        EXPECT_EQ(result.counts.at("unknown_samples"), unknown);
        return result.image.rgba[result.image.index(kColumn, 7)].a;
    };
    EXPECT_EQ(alpha(10.25, 13.75, 3 * kSidePx), 0.0);
    EXPECT_EQ(alpha(9.75, 13.75, 0), 4 / 32.0);  // with one colour sample it has all four
}

/// The sliver before a wall's edge: the wall weighs its share of the 29 samples left.
TEST(Csaa, UnknownSamplesCountForNothing) {
    Scene scene = test::makeScene({strip(kFarLeft, 20.25, -2), strip(10.25, 13.75, -1)});
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].base_color = {1, 0, 0, 1};
    scene.geometry[1].material = 1;
    for (const ShadingMode mode :
         {ShadingMode::kClosest, ShadingMode::kCentroid, ShadingMode::kSamples, ShadingMode::kHit}) {
        RenderOptions options = onPureBlue();
        options.shading = {mode, 4};
        const MethodResult result = render(scene, test::makeFilm(kSidePx, kSidePx), "csaa:32", options);
        const glm::dvec4 pixel = result.image.rgba[result.image.index(kColumn, 7)];
        const double share = 17.0 / 29;
        for (const int channel : {0, 1, 3}) EXPECT_NEAR(pixel[channel], share, 0x1p-48) << int(mode);
        EXPECT_NEAR(pixel.b, 1.0, 0x1p-48) << int(mode);
    }
}

/// Triangles of one colour each, many of them thin.
Scene randomScene() {
    constexpr int kTriangles = 60;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1, 1), value(0, 1);
    std::vector<Geometry> geometry;
    for (int i = 0; i < kTriangles; ++i) {
        test::Corners t;
        for (auto& p : t) p = glm::vec3(unit(random), unit(random), -2 + unit(random));
        if (i % 2 == 0) t[2] = t[1] + 0.02f * t[2];
        geometry.push_back(test::makeGeometry({t}));
    }
    Scene scene = test::makeScene(std::move(geometry));
    scene.materials.resize(kTriangles, scene.materials[0]);
    for (int i = 0; i < kTriangles; ++i) {
        scene.geometry[i].material = std::uint32_t(i);
        scene.materials[i].base_color = {value(random), value(random), value(random), 1};
    }
    return scene;
}

/// A sample is what `none` sees on a film that is shifted there, and colours tell owners apart: the pixel is
/// the mean of those samples that have the colour of one of the first eight.
TEST(Csaa, IsTheMeanOfKnownSamples) {
    constexpr int kSide = 24;
    const Scene scene = randomScene();
    Film film = test::makeFilm(kSide, kSide);
    const MethodResult got = render(scene, film, "csaa:32", onPureBlue());
    std::vector<std::vector<glm::dvec4>> seen(got.image.rgba.size());
    for (const glm::dvec2& p : coverageSampledPattern().at_px) {
        film.shift_px = p - 0.5;
        const MethodResult one = render(scene, film, "none", onPureBlue());
        for (std::size_t i = 0; i < seen.size(); ++i) seen[i].push_back(one.image.rgba[i]);
    }
    std::uint64_t unknown = 0, mixed = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        glm::dvec4 sum(0.0);
        int known = 0;
        const auto stored = std::span(seen[i]).first(kColorSamples);
        for (const glm::dvec4& sample : seen[i])
            if (std::ranges::find(stored, sample) != stored.end()) sum += sample, ++known;
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(got.image.rgba[i][c], sum[c] / known, 0x1p-46) << i;
        unknown += kSamples - known;
        mixed += stored.front() != stored.back();
    }
    EXPECT_EQ(got.counts.at("unknown_samples"), unknown);
    EXPECT_GT(unknown, 100u);
    EXPECT_GT(mixed, 50u);
}

/// For each number of known samples, owners weigh their shares, and together exactly 1.
TEST(Csaa, WeightsSumToOne) {
    const Scene scene = randomScene();
    const Film film = test::makeFilm(1, 1);
    const RenderOptions options;
    Progress progress;
    const Prefilter box = makePrefilter("box", {}, {});
    const ResolvedCamera camera = test::makeOrthographic(1.0);
    const SampledFrame frame({scene, camera, film, box, options, progress}, coverageSampledPattern(),
                             SampleWeights::equal(kSamples));
    std::mt19937 random(6);
    for (int known = 1; known <= kSamples; ++known) {
        SampledOwners sampled;
        sampled.owner.assign(kSamples, kUnknown);
        for (int i = 0; i < known; ++i) sampled.owner[i] = Owner(random() % 5);
        std::ranges::shuffle(sampled.owner, random);
        const std::vector<Owner> owner = sampled.owner;
        const SampleBand band = makeBand(film.crop, frame.pattern, std::move(sampled));
        FixedWeight sum = 0;
        for (const OwnerWeight& own : frame.pixels.ownersOf(band, 0, 0)) {
            const double share = double(std::ranges::count(owner, own.owner)) / known;
            EXPECT_NEAR(std::ldexp(double(own.weight), -kWeightBits), share, 0x1p-51) << known;
            EXPECT_NE(own.owner, kUnknown);
            sum += own.weight;
        }
        EXPECT_EQ(sum, FixedWeight(1) << kWeightBits) << known;
    }
}

TEST(Csaa, IsNearerToTheExactBoxThanEightSamples) {
    const auto picture = test::shippedPicture("torus-20k", 96, {0.3, 0.3});  // its outline
    const Prefilter box = makePrefilter("box", {}, {});
    const MethodResult truth = test::renderPicture(picture, box, test::onBlue(), "nsaa:device=cpu");
    EXPECT_GT(std::ranges::count(truth.image.edge, 1.0f), 100);
    const auto error = [&](const char* method) {
        const MethodResult result = test::renderPicture(picture, box, test::onBlue(), method);
        return judge::compareImages(result.image, truth.image);
    };
    const judge::ErrorMetrics csaa = error("csaa:32,device=cpu"), msaa = error("msaa:8,device=cpu");
    fmt::print("edge rmse: csaa:32 {:.5f}, msaa:8 {:.5f}; rmse {:.5f}, {:.5f}\n", *csaa.edge_rmse,
               *msaa.edge_rmse, csaa.rmse, msaa.rmse);
    EXPECT_LT(csaa.rmse, msaa.rmse);
    EXPECT_LT(*csaa.edge_rmse, *msaa.edge_rmse);
}

TEST(Csaa, CropThreadsAndMemoryDoNotShow) {
    test::expectCropThreadsAndMemoryDoNotShow("csaa:32");
}

}  // namespace
}  // namespace edgewise
