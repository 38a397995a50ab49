// Shade and blend on the device against the CPU's, on the CPU's entries: bit for bit.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <set>

#include "pipeline/vulkan/shader.h"
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

RenderOptions shadedAt(ShadingMode mode, int samples) {
    RenderOptions options = onBlue();
    options.shading = {mode, samples};
    return options;
}

TEST_F(ShadeTest, CentroidsAndSamplesHaveTheBitsOfTheCpu) {
    constexpr std::uint64_t kSeed = 70;
    Seen seen;
    for (std::uint64_t i = 0; i < 4; ++i) {
        test::MaterialScene made(kSeed + i, {});
        made.film.crop = {8, 8, 40, 40};
        const RenderOptions options =
            shadedAt(i % 2 == 0 ? ShadingMode::kCentroid : ShadingMode::kSamples, 4);
        const Comparison c = test::comparePicture(made.scene, made.camera, made.film,
                                                  makePrefilter("gaussian", {}, {}), options);
        expectTheSame(fmt::format("points, seed {}", kSeed + i), c);
        seen.add(c);
    }
    EXPECT_TRUE(seen.uses & kUsesPoints);
    EXPECT_GT(seen.points, 2 * seen.entries);
    EXPECT_GT(seen.stacks, 1000u);
}

/// Panes over the whole film, one behind the other.
test::MaterialScene panes(std::uint64_t seed, int count) {
    test::MaterialScene made(seed, {.lights = false}, count);
    for (std::size_t i = 0; i < made.scene.geometry.size(); ++i) {
        Geometry& g = made.scene.geometry[i];
        const double depth = 2.0 + 0.25 * static_cast<double>(i);
        const glm::dmat4 world = glm::inverse(made.camera.camera_from_world);
        for (std::size_t k = 0; k < g.position_world.size(); ++k) {
            const glm::vec3 p(k % 3 == 1 ? 300 : -300, k % 3 == 2 ? 300 : -300, -depth);
            g.position_file[k] = p;
            g.position_world[k] = glm::dvec3(world * glm::dvec4(glm::dvec3(p), 1.0));
        }
        Material& m = made.scene.materials[g.material];
        m.alpha_mode = AlphaMode::kBlend, m.double_sided = true;
    }
    return made;
}

TEST_F(ShadeTest, WhatTakesTooManyTurnsIsHandedBack) {
    test::MaterialScene made = panes(90, 60);
    made.film.crop = {30, 30, 34, 34};
    const Comparison c =
        test::comparePicture(made.scene, made.camera, made.film, makePrefilter("gaussian", {}, {}),
                             shadedAt(ShadingMode::kSamples, 16));
    expectTheSame("60 panes at 16 points", c);
    EXPECT_GT(c.handed_back, 0u);
    const Comparison closest =
        test::comparePicture(made.scene, made.camera, made.film, makePrefilter("gaussian", {}, {}), onBlue());
    expectTheSame("60 panes", closest);
    EXPECT_EQ(closest.handed_back, 0u);
}

TEST_F(ShadeTest, ColoursThatThePlanDoesNotKnowAreShadedOnce) {
    RenderOptions options = onBlue();
    options.no_skip = {"fetch"};
    const auto picture = shippedPicture("random-2k", 64);
    const Comparison c = test::comparePicture(picture.scene, picture.camera, picture.film,
                                              makePrefilter("gaussian", {}, {}), options);
    expectTheSame("random-2k, fetched", c);
    EXPECT_EQ(c.uses & (kUsesTable | kUsesVarying), 0u);
    const test::MaterialScene made(52, {});
    const Comparison materials =
        test::comparePicture(made.scene, made.camera, made.film, makePrefilter("gaussian", {}, {}), options);
    expectTheSame("seed 52, fetched", materials);
    EXPECT_EQ(materials.uses & kUsesTable, 0u);
}

/// Bytes of a record for each owner, and of what else is needed.
TEST_F(ShadeTest, WhatASceneDoesNotUseIsNotUploaded) {
    const Prefilter filter = makePrefilter("gaussian", {}, {});
    const auto flat = shippedPicture("random-2k", 32);
    const Comparison c = test::comparePicture(flat.scene, flat.camera, flat.film, filter, onBlue());
    print("constant", c);
    EXPECT_EQ(c.uses, kUsesTable);
    const std::size_t records = flat.scene.triangle_count * sizeof(OwnerRecord);
    EXPECT_GE(c.uploaded_bytes, records + sizeof(ShadeFrame));
    EXPECT_LE(c.uploaded_bytes,
              records + sizeof(ShadeFrame) + flat.scene.triangle_count * 4 * sizeof(double));

    test::MaterialScene made(53, {.lit = false, .lights = false, .alpha = false});
    for (Material& m : made.scene.materials) m.base_color_map = {};
    const Comparison colored = test::comparePicture(made.scene, made.camera, made.film, filter, onBlue());
    print("vertex colours", colored);
    EXPECT_EQ(colored.uses, kUsesTable | kUsesShading | kUsesVarying | kUsesVertexColors);
    std::size_t bytes = sizeof(ShadeFrame), vertices = 0;
    for (const Geometry& g : made.scene.geometry) vertices += g.position_world.size();
    bytes += made.scene.triangle_count * (sizeof(OwnerRecord) + 4 * sizeof(double));
    bytes += made.scene.geometry.size() * (sizeof(SurfaceRecord) + sizeof(MaterialRecord));
    bytes += vertices * (3 + 4) * sizeof(double);
    EXPECT_LE(colored.uploaded_bytes, bytes);
}

/// Each operation that rounds keeps its place: SPIR-V says so by NoContraction.
TEST(ShadeText, NoArithmeticMayBeContracted) {
    enum Op : std::uint32_t {
        kDecorate = 71,
        kFAdd = 129,
        kFSub = 131,
        kFMul = 133,
        kFDiv = 136,
        kScale = 142
    };
    constexpr std::uint32_t kNoContraction = 42, kHeaderWords = 5;
    for (const char* name : {"shade.comp", "blend.frag"}) {
        const auto words = spirv(name);
        std::set<std::uint32_t> exact;
        std::size_t operations = 0, loose = 0;
        for (std::size_t at = kHeaderWords; at < words.size(); at += words[at] >> 16) {
            const std::uint32_t op = words[at] & 0xffffu;
            if (op == kDecorate && words[at + 2] == kNoContraction) exact.insert(words[at + 1]);
            if (op != kFAdd && op != kFSub && op != kFMul && op != kFDiv && op != kScale) continue;
            ++operations, loose += !exact.contains(words[at + 2]);
        }
        EXPECT_EQ(loose, 0u) << name;
        EXPECT_GT(operations, 5u) << name;
    }
}

}  // namespace
}  // namespace edgewise::vulkan
