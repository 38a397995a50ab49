// Whole pictures of nsaa on the device against the CPU's: every bit of every pixel.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "pipeline/error.h"
#include "tests/pipeline/shipped_picture.h"
#include "tests/vulkan/test_device.h"

namespace edgewise::vulkan {
namespace {

constexpr int kSidePx = 40;

class NsaaVulkan : public testing::TestWithParam<scenes::Recipe> {};

TEST_P(NsaaVulkan, MakesTheCpusPicture) {
    test::device();  // validation on, for the method's own device too
    const auto picture = edgewise::test::shippedPicture(GetParam(), kSidePx);
    std::size_t pixels = 0, edges = 0;
    for (const char* name : {"box", "gaussian", "mitchell"}) {
        const Prefilter filter = makePrefilter(name, {}, {});
        const MethodResult host = edgewise::test::renderPicture(picture, filter, edgewise::test::onBlue(),
                                                                "nsaa:device=cpu"),
                           device = edgewise::test::renderPicture(picture, filter, edgewise::test::onBlue(),
                                                                  "nsaa:device=vulkan");
        EXPECT_EQ(host.device, "cpu");
        EXPECT_EQ(device.device, "vulkan");
        for (std::size_t i = 0; i < host.image.rgba.size(); ++i) {
            EXPECT_EQ(host.image.rgba[i], device.image.rgba[i]) << name << " pixel " << i;
            EXPECT_EQ(host.image.edge[i], device.image.edge[i]) << name << " pixel " << i;
            edges += host.image.edge[i] != 0.0f;
        }
        pixels += host.image.rgba.size();
    }
    fmt::print("{}: {} pixels, {} with edges\n", picture.name, pixels, edges);
    EXPECT_GT(edges, std::size_t{kSidePx}) << "a crop where nothing happens";
    test::expectNoMessages();
}

INSTANTIATE_TEST_SUITE_P(Shipped, NsaaVulkan, testing::ValuesIn(edgewise::test::shippedRecipes()),
                         [](const auto& one) { return edgewise::test::nameOf(one.param); });

/// A kernel of more pieces than its shader holds is weighed on the CPU, and the picture says so.
TEST(NsaaVulkanKernels, OneOfManyPiecesIsTheCpus) {
    test::device();
    const auto picture = edgewise::test::shippedPicture(edgewise::test::shippedRecipes()[0], 16);
    const Prefilter filter = makePrefilter("lanczos", 12.0, {});
    const auto render = [&](const char* method) {
        return edgewise::test::renderPicture(picture, filter, edgewise::test::onBlue(), method);
    };
    const MethodResult host = render("nsaa:device=cpu"), device = render("nsaa:device=vulkan");
    ASSERT_FALSE(device.notes.empty());
    EXPECT_NE(device.notes[0].find("48 polynomial pieces"), std::string::npos) << device.notes[0];
    EXPECT_EQ(host.image.rgba, device.image.rgba);
    test::expectNoMessages();
}

}  // namespace
}  // namespace edgewise::vulkan
