// Pictures of the oracle beside those of nsaa.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pipeline/error.h"
#include "pipeline/methods/exact.h"
#include "pipeline/methods/nsaa.h"
#include "tests/pipeline/shipped_picture.h"
#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

constexpr int kSidePx = 6;
constexpr double kTarget = 1e-12;  // of weights and colours in double, before the rounding to float32

class ExactMethod : public testing::TestWithParam<scenes::Recipe> {};

TEST_P(ExactMethod, NsaaMakesTheOraclesPicture) {
    const auto picture = test::shippedPicture(GetParam(), kSidePx);
    double worst = 0.0;
    for (const char* name : {"box", "gaussian"}) {
        const Prefilter filter = makePrefilter(name, {}, {});
        const MethodResult product = test::renderPicture(picture, filter, test::onBlue()),
                           truth = test::renderPicture(picture, filter, test::onBlue(), "exact");
        for (std::size_t i = 0; i < truth.image.rgba.size(); ++i)
            for (int c = 0; c < 4; ++c) {
                const double expected = truth.image.rgba[i][c];
                const double error = std::abs(product.image.rgba[i][c] - expected);
                EXPECT_LE(error, 3e-7 * std::max(1.0, std::abs(expected))) << name << " pixel " << i;
                EXPECT_LE(error, kTarget) << name << " pixel " << i;
                worst = std::max(worst, error);
            }
    }
    fmt::print("{}: worst difference {:.1e}\n", picture.name, worst);
}

/// Triangles of all colours that overlap and pierce each other.
Scene colouredSoup() {
    std::mt19937 random(91);
    std::uniform_real_distribution<float> side(-3, 3), depth(-9, -1);
    std::vector<test::Corners> triangles(5);
    for (auto& t : triangles)
        for (auto& p : t) p = {side(random), side(random), depth(random)};
    Geometry geometry = test::makeGeometry(triangles);
    for (const glm::dvec3& p : geometry.position_world)
        geometry.color.push_back({0.5 + 0.1 * p.x, 0.5 + 0.1 * p.y, 0.5 + 0.05 * p.z, 1.0});
    return test::makeScene({geometry});
}

/// Where nsaa shades, the oracle shades.
TEST(ExactMethodShading, IsNsaasInEveryMode) {
    const Scene scene = colouredSoup();
    constexpr int kFewPx = 4;                                            // the oracle takes its time
    const ResolvedCamera camera = test::makeOrthographic(kFewPx / 2.0);  // a world unit is a pixel
    const Film film = test::makeFilm(kFewPx, kFewPx);
    Progress progress;
    for (const char* name : {"gaussian", "box"}) {
        const Prefilter filter = makePrefilter(name, {}, {});
        const auto render = [&](const char* method, ShadingChoice shading) {
            RenderOptions options;
            options.shading = shading;
            return runMethod(parseMethod(method), {scene, camera, film, filter, options, progress});
        };
        const ImageBuffer closest = render("exact", {}).image;
        for (const ShadingChoice shading : {ShadingChoice{ShadingMode::kClosest, 1},
                                            {ShadingMode::kCentroid, 1},
                                            {ShadingMode::kSamples, 4},
                                            {ShadingMode::kHit, 1}}) {
            const MethodResult truth = render("exact", shading), product = render("nsaa", shading);
            double worst = 0.0;
            for (std::size_t i = 0; i < truth.image.rgba.size(); ++i)
                for (int c = 0; c < 4; ++c)
                    worst = std::max(worst, std::abs(truth.image.rgba[i][c] - product.image.rgba[i][c]));
            EXPECT_LE(worst, kTarget) << name << " mode " << int(shading.mode);
            const bool elsewhere =
                shading.mode == ShadingMode::kCentroid || shading.mode == ShadingMode::kSamples;
            EXPECT_EQ(truth.image.rgba != closest.rgba, elsewhere) << name << " mode " << int(shading.mode);
            EXPECT_EQ(truth.notes.size(), shading.mode == ShadingMode::kHit ? 1u : 0u);
        }
    }
}

TEST(ExactMethodLimits, ChannelsAreAWrongCommandLine) {
    const auto picture = test::shippedPicture("torus-20k", 2);
    RenderOptions options;
    options.aovs = {Aov::kDepth};
    EXPECT_THROW(test::renderPicture(picture, makePrefilter("box", {}, {}), options, "exact"), InputError);
}

TEST(ExactMethodLimits, TooManyTrianglesAndPanesAreRefused) {
    auto picture = test::shippedPicture("torus-20k", 1024);
    const Prefilter filter = makePrefilter("box", {}, {});
    EXPECT_THROW(test::renderPicture(picture, filter, {}, "exact"), FailureError);
    picture = test::shippedPicture("torus-20k", 2);
    for (Material& material : picture.scene.materials)
        material.alpha_mode = AlphaMode::kBlend, material.base_color.a = 0.5;
    EXPECT_THROW(test::renderPicture(picture, filter, {}, "exact"), FailureError);
}

TEST(ExactMethodLimits, WeightsAreListedBesideTheProducts) {
    const auto picture = test::shippedPicture("torus-20k", 4);
    const Prefilter filter = makePrefilter("gaussian", {}, {});
    Progress progress;
    const RenderOptions options;
    const MethodInput input{picture.scene, picture.camera, picture.film, filter, options, progress};
    const int x = picture.film.crop.x0 + 1, y = picture.film.crop.y0 + 1;
    const PixelReport report = pixelWeights(input, x, y);
    std::vector<std::pair<Owner, double>> product;
    for (const PixelOwner& owner : report.owners) product.emplace_back(owner.index, owner.weight);
    product.emplace_back(kBackground, report.background);
    const auto exact = exactWeights(input, x, y, product);
    ASSERT_FALSE(exact.empty());
    double sum = 0.0;
    for (const ExactWeight& w : exact) {
        sum += w.nearest;
        if (w.nearest > 0x1p-20) {
            const double ulp = std::nextafter(w.nearest, 2.0) - w.nearest;
            EXPECT_LE(std::abs(w.ulp_off) * ulp, kTarget) << w.owner;
            EXPECT_GE(w.digits.size(), 30u) << w.owner;
        }
    }
    // Each is rounded to a double, and so is each partial sum.
    EXPECT_NEAR(sum, 1.0, 2 * 0x1p-53 * static_cast<double>(exact.size()));
}

INSTANTIATE_TEST_SUITE_P(Shipped, ExactMethod, testing::ValuesIn(scenes::degenerateRecipes()),
                         [](const auto& one) { return test::nameOf(one.param); });

}  // namespace
}  // namespace edgewise
