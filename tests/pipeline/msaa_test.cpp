// The method msaa on the CPU, and the standard sample locations.
#include <gtest/gtest.h>

#include "pipeline/error.h"
#include "pipeline/methods/sample_weights.h"
#include "pipeline/sample_pattern.h"
#include "tests/pipeline/shipped_picture.h"
#include "tests/pipeline/standard_locations.h"
#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

TEST(Msaa, LocationsAreTheSpecifications) {
    for (const auto& [samples, at] : test::standardLocations()) {
        const SamplePattern pattern = standardPattern(samples);
        EXPECT_EQ(pattern.at_px, at) << samples;
        EXPECT_EQ(pattern.size(), samples);
    }
}

TEST(Msaa, SamplesWeighAlike) {
    for (const int samples : {1, 2, 4, 8, 16}) {
        const SampleWeights weights = SampleWeights::equal(samples);
        ASSERT_EQ(weights.rows.size(), 1u);
        EXPECT_EQ(weights.rows[0].of(0, samples), FixedWeight(1) << kWeightBits);
        for (int s = 0; s < samples; ++s)
            EXPECT_EQ(weights.rows[0].of(s, s + 1) * samples, FixedWeight(1) << kWeightBits);
    }
}

TEST(Msaa, OtherCountsAreRefused) {
    for (const char* wrong : {"msaa", "msaa:0", "msaa:1", "msaa:3", "msaa:32"})
        EXPECT_THROW(parseMethod(wrong), InputError) << wrong;
}

MethodResult render(const Scene& scene, const Film& film, const std::string& method,
                    const RenderOptions& options = {}) {
    Progress progress;
    return runMethod(parseMethod(method), {scene, test::makeOrthographic(1.0), film,
                                           makePrefilter("gaussian", {}, {}), options, progress});
}

/// A white wall whose right edge steps over a pixel in sixteenths: what it covers is what lies left of it.
TEST(Msaa, HalfPlaneByHand) {
    constexpr int kSidePx = 16, kColumn = 5;
    RenderOptions options;
    options.background = {0, 0, 1};
    for (const auto& [samples, at] : test::standardLocations())
        for (int step = 0; step < 16; ++step) {
            const double edge_px = kColumn + (step + 0.5) / 16;
            const auto x = static_cast<float>(2 * edge_px / kSidePx - 1);
            const Scene scene = test::makeScene({test::makeGeometry(
                {{{{-9, -9, -1}, {x, -9, -1}, {x, 9, -1}}}, {{{-9, -9, -1}, {x, 9, -1}, {-9, 9, -1}}}})});
            const MethodResult result =
                render(scene, test::makeFilm(kSidePx, kSidePx), "msaa:" + std::to_string(samples), options);
            double cover = 0.0;
            for (const glm::dvec2& p : at) cover += kColumn + p.x < edge_px ? 1.0 / samples : 0.0;
            const std::size_t i = result.image.index(kColumn, 7);
            EXPECT_EQ(result.image.rgba[i], glm::dvec4(cover, cover, 1, cover)) << samples << " " << step;
            EXPECT_EQ(result.image.edge[i], cover > 0.0 && cover < 1.0 ? 1.0f : 0.0f);
        }
}

/// A sample is what `none` sees on a film that is shifted there. Moving the film rounds corners anew, by less
/// than any sample here is from an edge; alpha is a sum of weights, so it is exact.
TEST(Msaa, IsTheMeanOfShiftedFilms) {
    const auto picture = test::shippedPicture("thin-wires", 48);
    for (const auto& [samples, at] : test::standardLocations()) {
        const MethodResult got =
            test::renderPicture(picture, makePrefilter("box", {}, {}), {},
                                ("msaa:" + std::to_string(samples) + ",device=cpu").c_str());
        std::vector<double> alpha(got.image.rgba.size(), 0.0);
        for (const glm::dvec2& p : at) {
            auto shifted = picture;
            shifted.film.shift_px += p - 0.5;
            const MethodResult one =
                test::renderPicture(shifted, makePrefilter("box", {}, {}), {}, "none:device=cpu");
            for (std::size_t i = 0; i < alpha.size(); ++i) alpha[i] += one.image.rgba[i].a / samples;
        }
        std::size_t mixed = 0;
        for (std::size_t i = 0; i < alpha.size(); ++i) {
            EXPECT_EQ(got.image.rgba[i].a, alpha[i]) << samples << " pixel " << i;
            mixed += alpha[i] > 0.0 && alpha[i] < 1.0;
        }
        EXPECT_GT(mixed, 10u) << samples;
    }
}

TEST(Msaa, CropThreadsAndMemoryDoNotShow) {
    test::expectCropThreadsAndMemoryDoNotShow("msaa:8");
}

}  // namespace
}  // namespace edgewise
