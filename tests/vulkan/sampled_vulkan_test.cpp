// Whole pictures of none, ssaa and msaa on the device against the CPU's.
#include "pipeline/methods/sampled_vulkan.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "pipeline/error.h"
#include "tests/pipeline/shipped_picture.h"
#include "tests/pipeline/test_scene.h"
#include "tests/vulkan/test_device.h"
#include "tests/witness/dice.h"

namespace edgewise::vulkan {
namespace {

constexpr int kSidePx = 64;

class SampledVulkan : public test::DeviceTest {
  protected:
    void SetUp() override { test::device(); }  // validation on, for the method's own device too
};

/// Triangles whose corners no snapping moves on a film of 64 px, the depths far apart, each vertex with its
/// colour.
Scene snappedScene(witness::Dice& dice, int count) {
    std::vector<edgewise::test::Corners> triangles(count);
    for (auto& t : triangles) {
        const auto z = static_cast<float>(-1 - dice.integer(0, 4000) / 64.0);
        for (glm::vec3& p : t) p = {dice.integer(-300, 300) / 256.0f, dice.integer(-300, 300) / 256.0f, z};
    }
    Geometry geometry = edgewise::test::makeGeometry(triangles);
    for (std::size_t i = 0; i < geometry.position_world.size(); ++i)
        geometry.color.push_back({dice.uniform(0, 1), dice.uniform(0, 1), dice.uniform(0, 1), 1});
    return edgewise::test::makeScene({geometry});
}

struct Sampling {
    std::string method;
    SamplePattern pattern;
    SampleWeights weights;
};

std::vector<Sampling> samplings(const Prefilter& filter) {
    std::vector<Sampling> all{{"none", latticePattern(1), SampleWeights::equal(1)}};
    for (const int k : {1, 2, 4})
        all.push_back({"ssaa:" + std::to_string(k), latticePattern(k), SampleWeights(filter, k)});
    for (const int n : {2, 4, 8, 16})
        all.push_back({"msaa:" + std::to_string(n), standardPattern(n), SampleWeights::equal(n)});
    return all;
}

std::size_t expectEqual(const MethodResult& host, const MethodResult& device, const std::string& what) {
    std::size_t edges = 0, wrong = 0;
    for (std::size_t i = 0; i < host.image.rgba.size(); ++i) {
        if ((host.image.rgba[i] != device.image.rgba[i] || host.image.edge[i] != device.image.edge[i]) &&
            wrong++ < 3)
            ADD_FAILURE() << what << " pixel " << i % kSidePx << ", " << i / kSidePx << ": "
                          << device.image.rgba[i].r << " " << device.image.rgba[i].a << ", not "
                          << host.image.rgba[i].r << " " << host.image.rgba[i].a;
        edges += host.image.edge[i] != 0.0f;
    }
    EXPECT_EQ(wrong, 0u) << what;
    return edges;
}

TEST_F(SampledVulkan, SnappedScenesHaveTheBitsOfTheCpu) {
    constexpr std::uint64_t kSeed = 31;
    witness::Dice dice(kSeed);
    std::size_t edges = 0, pictures = 0;
    for (const char* name : {"box", "gaussian", "mitchell"}) {
        const Scene scene = snappedScene(dice, 80);
        const Film film = edgewise::test::makeFilm(kSidePx, kSidePx);
        const ResolvedCamera camera = edgewise::test::makeOrthographic(1.0);
        const Prefilter filter = makePrefilter(name, {}, {});
        const RenderOptions options = edgewise::test::onBlue();
        Progress progress;
        const MethodInput in{scene, camera, film, filter, options, progress};
        for (const Sampling& s : samplings(filter)) {
            const std::string plain = s.method + (s.method == "none" ? ":" : ",");
            const MethodResult host = runMethod(parseMethod(plain + "device=cpu"), in),
                               fast = runMethod(parseMethod(plain + "device=vulkan"), in),
                               device = runSampledVulkan(in, s.pattern, s.weights, FilterPlace::kDevice);
            EXPECT_EQ(host.device, "cpu");
            EXPECT_EQ(fast.device, "vulkan");
            EXPECT_EQ(device.device, "vulkan");
            EXPECT_EQ(device.notes.size(), 1u) << "some of it was made on the CPU";
            EXPECT_GT(device.setup_seconds, 0.0);
            expectEqual(host, fast, s.method + " " + name);
            edges += expectEqual(host, device, s.method + " " + name + " on the device");
            ++pictures;
        }
    }
    fmt::print("seed {}: {} pictures, {} pixels with edges\n", kSeed, pictures, edges);
    EXPECT_GT(edges, 1000u);
}

/// More owners in a support than an invocation holds: the host resolves those pixels.
TEST_F(SampledVulkan, CrowdedPixelsAreHandedBack) {
    witness::Dice dice(32);
    std::vector<edgewise::test::Corners> triangles;
    for (int i = 0; i < 4000; ++i) {
        const glm::vec3 at(dice.integer(-256, 256) / 256.0f, dice.integer(-256, 256) / 256.0f,
                           -1.0f - i / 64.0f);
        triangles.push_back({at, at + glm::vec3(8 / 256.0f, 0, 0), at + glm::vec3(0, 8 / 256.0f, 0)});
    }
    const Scene scene = edgewise::test::makeScene({edgewise::test::makeGeometry(triangles)});
    const Film film = edgewise::test::makeFilm(32, 32);
    const ResolvedCamera camera = edgewise::test::makeOrthographic(1.0);
    const Prefilter filter = makePrefilter("gaussian", 4.0, {});
    const RenderOptions options = edgewise::test::onBlue();
    Progress progress;
    const MethodInput in{scene, camera, film, filter, options, progress};
    const MethodResult host = runMethod(parseMethod("ssaa:2,device=cpu"), in),
                       device = runSampledVulkan(in, latticePattern(2), SampleWeights(filter, 2),
                                                 FilterPlace::kDevice);
    EXPECT_GT(device.counts.at("pixels_handed_back"), 100u);
    expectEqual(host, device, "crowded");
}

/// Other places to shade, and AOVs that want owners: the device rasterizes, the CPU does the rest, and says
/// so.
TEST_F(SampledVulkan, WhatTheDeviceDoesNotShadeIsShadedOnTheCpu) {
    witness::Dice dice(33);
    const Scene scene = snappedScene(dice, 80);
    const Film film = edgewise::test::makeFilm(kSidePx, kSidePx);
    const ResolvedCamera camera = edgewise::test::makeOrthographic(1.0);
    const Prefilter filter = makePrefilter("tent", {}, {});
    for (const ShadingMode mode : {ShadingMode::kCentroid, ShadingMode::kSamples, ShadingMode::kHit})
        for (const char* method : {"none:", "ssaa:2,", "msaa:4,", "msaa:8,"}) {
            RenderOptions options = edgewise::test::onBlue();
            options.shading = {mode, 2};
            Progress progress;
            const MethodInput in{scene, camera, film, filter, options, progress};
            const MethodResult host = runMethod(parseMethod(std::string(method) + "device=cpu"), in),
                               device = runMethod(parseMethod(std::string(method) + "device=vulkan"), in);
            EXPECT_EQ(device.device, "vulkan");
            EXPECT_EQ(device.notes.size(), method == std::string("none:") ? 1u : 2u) << method;
            expectEqual(host, device, method);
        }
}

TEST_F(SampledVulkan, MemoryAndCropsDoNotShow) {
    auto picture = edgewise::test::shippedPicture("log-grid", 60);
    const Prefilter filter = makePrefilter("gaussian", {}, {});
    const auto render = [&](std::size_t memory_mib, const Sampling& s) {
        RenderOptions options = edgewise::test::onBlue();
        options.memory_mib = memory_mib;
        Progress progress;
        return runSampledVulkan({picture.scene, picture.camera, picture.film, filter, options, progress},
                                s.pattern, s.weights, FilterPlace::kDevice);
    };
    for (const Sampling& s : samplings(filter)) {
        if (s.method == "ssaa:1") continue;
        const MethodResult whole = render(1024, s), rows = render(0, s);
        expectEqual(whole, rows, s.method + " a row at a time");
    }
}

TEST_F(SampledVulkan, WhatIsSeenThroughIsMadeOnTheCpu) {
    Scene scene = edgewise::test::makeScene(
        {edgewise::test::makeGeometry({{{{-1, -1, -1}, {1, -1, -1}, {0, 1, -1}}}})});
    scene.materials[0].alpha_mode = AlphaMode::kBlend;
    scene.materials[0].base_color = {1, 0, 0, 0.5};
    const Film film = edgewise::test::makeFilm(16, 16);
    const ResolvedCamera camera = edgewise::test::makeOrthographic(1.0);
    const Prefilter filter = makePrefilter("box", {}, {});
    const RenderOptions options = edgewise::test::onBlue();
    Progress progress;
    const MethodInput in{scene, camera, film, filter, options, progress};
    const MethodResult host = runMethod(parseMethod("msaa:4,device=cpu"), in),
                       device = runMethod(parseMethod("msaa:4,device=vulkan"), in);
    EXPECT_EQ(device.device, "cpu");
    ASSERT_FALSE(device.notes.empty());
    EXPECT_NE(device.notes[0].find("seen through"), std::string::npos) << device.notes[0];
    EXPECT_EQ(host.image.rgba, device.image.rgba);
}

TEST_F(SampledVulkan, AScreenWithoutTrianglesIsTheBackground) {
    const Scene scene = edgewise::test::makeScene({});
    const Film film = edgewise::test::makeFilm(16, 16);
    const ResolvedCamera camera = edgewise::test::makeOrthographic(1.0);
    const Prefilter filter = makePrefilter("box", {}, {});
    const RenderOptions options = edgewise::test::onBlue();
    Progress progress;
    const MethodInput in{scene, camera, film, filter, options, progress};
    for (const char* method : {"none:device=vulkan", "ssaa:2,device=vulkan", "msaa:4,device=vulkan"})
        for (const glm::dvec4& pixel : runMethod(parseMethod(method), in).image.rgba)
            EXPECT_EQ(pixel, glm::dvec4(options.background, 0.0)) << method;
}

}  // namespace
}  // namespace edgewise::vulkan
