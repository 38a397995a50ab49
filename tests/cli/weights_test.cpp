// `edgewise weights`: numbers that read back exactly and sum to what they say.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/cli/run_program.h"

namespace edgewise::test {
namespace {

nlohmann::json weightsOf(const Arguments& more) {
    Arguments arguments{"weights", "torus-20k", "--size", "64x64"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.status, 0) << run.err;
    return nlohmann::json::parse(run.out);
}

TEST(Weights, NameTheirPrimitives) {
    const auto json = weightsOf({"--pixel", "32,50"});
    EXPECT_EQ(json.at("pixel"), (std::vector<int>{32, 50}));
    EXPECT_EQ(json.at("size"), (std::vector<int>{64, 64}));
    EXPECT_EQ(json.at("filter").at("name"), "gaussian");
    EXPECT_EQ(json.at("filter").at("radius"), 2.0);
    ASSERT_GT(json.at("weights").size(), 10u);  // 20,000 triangles on 4096 pixels
    for (const auto& owner : json.at("weights")) {
        EXPECT_LT(owner.at("index").get<int>(), 20000);
        EXPECT_EQ(owner.at("index"), owner.at("triangle"));  // the scene is one primitive
        EXPECT_EQ(owner.at("primitive"), 0);
        EXPECT_EQ(owner.at("layers"), std::vector<int>{owner.at("index").get<int>()});
        EXPECT_EQ(owner.at("color").size(), 3u);
    }
}

// Weights are multiples of 2^-60 that sum to exactly 1; each is printed as the nearest double.
TEST(Weights, SumToOne) {
    const auto json = weightsOf({"--pixel", "32,50", "--filter", "box"});
    EXPECT_EQ(json.at("sum"), 1.0);
    double sum = json.at("background");
    double magnitude = std::abs(sum);
    for (const auto& owner : json.at("weights")) {
        sum += owner.at("weight").get<double>();
        magnitude += std::abs(owner.at("weight").get<double>());
    }
    const double additions = static_cast<double>(json.at("weights").size()) + 1.0;
    EXPECT_LE(std::abs(sum - 1.0),
              2.0 * additions * 0x1p-53 * magnitude);  // a rounding a weight, one an addition
}

TEST(Weights, OfADeviceAreTheSame) {
#ifndef EDGEWISE_HAS_VULKAN
    GTEST_SKIP() << "this build has no Vulkan";
#endif
    const Arguments pixel{"--pixel", "32,50"};
    for (const char* precision : {"fp64", "fp32"}) {
        Arguments device = pixel, host = pixel;
        device.insert(device.end(), {"--device", "vulkan", "--precision", precision});
        host.insert(host.end(), {"--device", "cpu", "--precision", precision});
        EXPECT_EQ(weightsOf(device), weightsOf(host)) << precision;
    }
}

TEST(Weights, EmptySkyIsAllBackground) {
    const auto json = weightsOf({"--pixel", "0,0"});
    EXPECT_EQ(json.at("weights").size(), 0u);
    EXPECT_EQ(json.at("background"), 1.0);
    EXPECT_EQ(json.at("sum"), 1.0);
}

TEST(Weights, APixelOutsideThePictureIsAnError) {
    for (const char* pixel : {"64,0", "0,64", "-1,0", "0.5,0", "nan,0", "1"}) {
        const ProgramRun run = runProgram({"weights", "torus-20k", "--size", "64x64", "--pixel", pixel});
        EXPECT_EQ(run.status, 2) << pixel;
        EXPECT_EQ(lines(run.err).size(), 1u) << run.err;
    }
}

}  // namespace
}  // namespace edgewise::test
