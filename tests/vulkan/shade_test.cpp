// Shade and blend on the device against the CPU's, on the CPU's entries: bit for bit.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "tests/pipeline/shipped_picture.h"
#include "tests/vulkan/material_scenes.h"
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

/// What random scenes have met.
struct Seen {
    std::uint32_t uses = 0;
    std::size_t entries = 0, stacks = 0, points = 0, edges = 0, handed_back = 0;
    void add(const Comparison& c) {
        uses |= c.uses, entries += c.entries, stacks += c.stacks, points += c.points, edges += c.edges;
        handed_back += c.handed_back;
    }
};

TEST_F(ShadeTest, MaterialsOfEveryKindHaveTheBitsOfTheCpu) {
    constexpr std::uint64_t kSeed = 50;
    Seen seen;
    for (std::uint64_t i = 0; i < 16; ++i) {
        test::MaterialFeatures features;
        if (i % 2 == 1) features.lights = false;
        if (i % 4 == 2) features.alpha = false;
        if (i % 8 == 4) features.textures = false;
        if (i % 8 == 5) features.lit = false;
        if (i % 8 == 6) features.normals = false;
        if (i % 8 == 7) features.colors = false;
        const test::MaterialScene made(kSeed + i, features);
        const Comparison c = test::comparePicture(made.scene, made.camera, made.film,
                                                  makePrefilter("gaussian", {}, {}), onBlue(), true);
        expectTheSame(fmt::format("seed {}", kSeed + i), c);
        seen.add(c);
    }
    EXPECT_EQ(seen.uses, 2 * kUsesAlpha - 1 - kUsesPoints);
    EXPECT_GT(seen.entries, 50000u);
    EXPECT_GT(seen.stacks, 10000u);
    EXPECT_GT(seen.edges, 10000u);
}

}  // namespace
}  // namespace edgewise::vulkan
