// Errors whose sums a hand can follow, what is refused, and the same bits for any number of threads.
#include "pipeline/judge/metrics.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "pipeline/error.h"
#include "pipeline/judge/flip.h"
#include "tests/pipeline/metric_pictures.h"

namespace edgewise::judge {
namespace {

using namespace test;

/// 4 x 2 black pixels.
ImageBuffer black() {
    return constantPicture(4, 2, glm::dvec3(0.0));
}

TEST(Metrics, OfAPictureWithItselfHaveNoPsnr) {
    const PicturePair pair = diskPair();
    const ErrorMetrics metrics = compareImages(pair.image, pair.image);
    EXPECT_EQ(metrics.rmse, 0.0);
    EXPECT_EQ(metrics.max, 0.0);
    EXPECT_EQ(metrics.bias, 0.0);
    EXPECT_FALSE(metrics.psnr);
    EXPECT_DOUBLE_EQ(metrics.ssim, 1.0);
    EXPECT_EQ(metrics.flip, 0.0);
}

// Errors 0.5, -0.25 and 0.125 in 24 values.
TEST(Metrics, AreThoseOfAHandfulOfErrors) {
    ImageBuffer image = black();
    image.rgba[1] = {0.5, -0.25, 0.0, 77.0};  // alpha is left out
    image.rgba[6] = {0.0, 0.0, 0.125, 1.0};
    const ErrorMetrics metrics = compareImages(image, black());
    const double mean_square = (0.25 + 0.0625 + 0.015625) / 24.0;
    EXPECT_DOUBLE_EQ(metrics.rmse, std::sqrt(mean_square));
    EXPECT_EQ(metrics.max, 0.5);
    EXPECT_DOUBLE_EQ(metrics.bias, 0.375 / 24.0);
    EXPECT_DOUBLE_EQ(metrics.psnr.value(), 10.0 * std::log10(1.0 / mean_square));
    EXPECT_EQ(compareImages(black(), image).bias, -metrics.bias);
    EXPECT_FALSE(metrics.edge_rmse);
    EXPECT_FALSE(metrics.edge_psnr);
    EXPECT_LT(metrics.ssim, 1.0);
}

TEST(Metrics, LargestErrorMayBeNegative) {
    ImageBuffer image = black();
    image.rgba[0].g = -3.0;
    EXPECT_EQ(compareImages(image, black()).max, 3.0);
}

TEST(Metrics, OfEdgesCountTheReferencesEdges) {
    ImageBuffer image = black(), reference = black();
    image.rgba[1] = {0.5, 0.5, 0.5, 1.0};
    image.rgba[2] = {1.0, 1.0, 1.0, 1.0};
    reference.edge[0] = reference.edge[1] = 1.0f;
    image.edge[2] = 1.0f;  // the image's own do not count
    const ErrorMetrics metrics = compareImages(image, reference);
    EXPECT_DOUBLE_EQ(metrics.edge_rmse.value(), std::sqrt(0.125));
    EXPECT_DOUBLE_EQ(metrics.edge_psnr.value(), 10.0 * std::log10(8.0));
    reference.edge.assign(reference.edge.size(), 0.0f);
    reference.edge[7] = 1.0f;
    EXPECT_EQ(compareImages(image, reference).edge_rmse, 0.0);
    EXPECT_FALSE(compareImages(image, reference).edge_psnr);  // no error there
    reference.edge.clear();
    EXPECT_FALSE(compareImages(image, reference).edge_rmse);  // no channel
}

TEST(Metrics, FlipIsTheMapsMean) {
    const PicturePair pair = checkerPair();
    const std::vector<double> map = flipMap(pair.image, pair.reference);
    const double mean = std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
    const double any_order = static_cast<double>(map.size()) * 0x1p-52 * mean;  // of adding positive numbers
    EXPECT_NEAR(compareImages(pair.image, pair.reference).flip, mean, any_order);
}

TEST(Metrics, SignedErrorsAreImageMinusReference) {
    ImageBuffer image = black(), reference = black();
    image.rgba[3] = {0.25, 0.5, 1.0, 1.0};
    reference.rgba[3] = {1.0, 0.5, 0.0, 0.0};
    const auto errors = signedErrors(image, reference);
    ASSERT_EQ(errors.size(), 8u);
    EXPECT_EQ(errors[3], glm::dvec3(-0.75, 0.0, 1.0));
    EXPECT_EQ(errors[0], glm::dvec3(0.0));
}

TEST(Metrics, BoxesMayLieElsewhere) {
    ImageBuffer crop({10, 20, 14, 22});
    EXPECT_EQ(compareImages(crop, black()).rmse, 0.0);
}

std::string refusal(const ImageBuffer& image, const ImageBuffer& reference) {
    try {
        compareImages(image, reference, "a.exr", "b.exr");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Metrics, OtherSizesAreRefusedNamingBoth) {
    EXPECT_EQ(refusal(black(), constantPicture(2, 4, glm::dvec3(0.0))), "a.exr: is 4x2 pixels, b.exr is 2x4");
}

TEST(Metrics, WhatIsNotFiniteIsRefusedNamingThePixel) {
    ImageBuffer image({10, 20, 14, 22});
    image.rgba[6].b = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refusal(image, black()), "a.exr: pixel 12,21 is nan, not a finite number");
    EXPECT_EQ(refusal(black(), image), "b.exr: pixel 12,21 is nan, not a finite number");
    image.rgba[6].b = 0.0;
    image.rgba[1].r = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(refusal(image, black()), "a.exr: pixel 11,20 is -inf, not a finite number");
    image.rgba[1].r = 0.0;
    image.rgba[1].a = std::numeric_limits<double>::quiet_NaN();  // alpha is left out
    EXPECT_EQ(refusal(image, black()), "accepted");
    image.edge[4] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(refusal(image, black()), "accepted");
    EXPECT_EQ(refusal(black(), image), "b.exr: pixel 10,21 is nan, not a finite number");
}

TEST(Metrics, HaveTheSameBitsForAnyNumberOfThreads) {
    const PicturePair pair{noisePicture(3, 1.5), noisePicture(4, 1.0)};
    std::vector<nlohmann::ordered_json> found;
    for (const std::size_t threads : {1, 2, 7}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        found.push_back(metricsJson(compareImages(pair.image, pair.reference)));
    }
    EXPECT_EQ(found[0].dump(), found[1].dump());
    EXPECT_EQ(found[0].dump(), found[2].dump());
}

TEST(Metrics, JsonHasTheContractsNames) {
    const auto json = metricsJson(compareImages(black(), black()));
    std::vector<std::string> names;
    for (const auto& [name, value] : json.items()) names.push_back(name);
    EXPECT_EQ(names, (std::vector<std::string>{"rmse", "max", "bias", "psnr", "edge_rmse", "edge_psnr",
                                               "ssim", "flip"}));
    EXPECT_TRUE(json.at("psnr").is_null());
    EXPECT_TRUE(json.at("edge_rmse").is_null());
    EXPECT_EQ(json.at("ssim"), 1.0);
    EXPECT_EQ(json.at("flip"), 0.0);
}

}  // namespace
}  // namespace edgewise::judge
