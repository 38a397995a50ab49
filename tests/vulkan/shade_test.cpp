// Shade and blend on the device against the CPU's, on the CPU's entries: bit for bit.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "tests/pipeline/shipped_picture.h"
#include "tests/vulkan/shaded_picture.h"

namespace edgewise::vulkan {
namespace {

using edgewise::test::onBlue;
using edgewise::test::shippedPicture;
using test::Comparison;

void print(const std::string& name, const Comparison& c) {
    fmt::print(
        "{:24} {} pixels, {} entries, {} of stacks, {} points; {} differ, worst {} ulp, {} edges; {} handed "
        "back; {} KiB up",
        name, c.pixels, c.entries, c.stacks, c.points, c.differing, c.worst_ulps, c.edges, c.handed_back,
        c.uploaded_bytes >> 10);
    if (std::getenv("EDGEWISE_TEST_TIMES"))
        fmt::print("; first {:.0f} ms, shade {:.1f}, blend {:.1f}, one CPU thread {:.1f} ms",
                   1e3 * c.first_seconds, 1e3 * c.shade_seconds, 1e3 * c.blend_seconds, 1e3 * c.cpu_seconds);
    fmt::print("\n");
}

void expectTheSame(const std::string& name, const Comparison& c) {
    print(name, c);
    EXPECT_EQ(c.why_not, "") << name;
    EXPECT_GT(c.pixels, 0u) << name;
    EXPECT_EQ(c.differing, 0u) << name;
    EXPECT_EQ(c.edges_differing, 0u) << name;
}

class ShadeTest : public test::DeviceTest {};

TEST_F(ShadeTest, ShippedScenesHaveTheBitsOfTheCpu) {
    const Prefilter filter = makePrefilter("gaussian", {}, {});
    std::size_t edges = 0;
    for (const scenes::Recipe& recipe : edgewise::test::shippedRecipes()) {
        const auto picture = shippedPicture(recipe, 96);
        const Comparison c =
            test::comparePicture(picture.scene, picture.camera, picture.film, filter, onBlue(), true);
        expectTheSame(picture.name, c);
        edges += c.edges;
    }
    EXPECT_GT(edges, 1000u);
}

}  // namespace
}  // namespace edgewise::vulkan
