// The shrinker on properties that are known to fail.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "analytic/exact/visible_faces.h"
#include "pipeline/project.h"
#include "tests/pipeline/tiny_gltf_file.h"
#include "tests/property/run_property.h"
#include "tests/property/shrink.h"

namespace edgewise::property {
namespace {

/// Whether somewhere in the box two triangles are the nearest ones.
bool anyTie(const View& view) {
    const PixelBox& b = view.film.crop;
    const auto faces = exact::visibleFaces(project(view.scene, view.camera, view.film),
                                           {double(b.x0), double(b.y0), double(b.x1), double(b.y1)});
    return std::ranges::any_of(faces, [](const exact::Face& face) { return face.tied.size() > 1; });
}

/// Untrue on purpose.
Outcome noTwoTrianglesTie(const Trial& trial) {
    if (!anyTie(viewOf(trial.scene, trial.box))) return {};
    return {true, Violation{"two triangles tie", {trial.box.x0, trial.box.y0}}};
}

int bitsOf(const WorldScene& scene) {
    int bits = 0;
    for (const WorldTriangle& t : scene.triangles)
        for (const glm::vec3& p : t.p_world)
            for (int axis = 0; axis < 3; ++axis) bits += significantBits(p[axis]);
    return bits;
}

TEST(Shrink, TwoTrianglesAreLeftOfATie) {
    int shrunk = 0;
    for (std::uint64_t seed = 1; shrunk < 5; ++seed) {
        const Trial trial = trialOf(seed);
        if (trial.scene.triangles.size() < 8 || !noTwoTrianglesTie(trial).wrong) continue;
        const WorldScene small =
            shrink(trial.scene, [&](const WorldScene& scene) { return anyTie(viewOf(scene, trial.box)); });
        fmt::print("seed {}: {} triangles of {} bits became {} of {}\n", seed, trial.scene.triangles.size(),
                   bitsOf(trial.scene), small.triangles.size(), bitsOf(small));
        EXPECT_EQ(small.triangles.size(), 2u) << seed;
        EXPECT_LT(bitsOf(small), 3 * int(small.triangles.size()) * 3 * 3) << "of 18 coordinates, 3 bits each";
        EXPECT_TRUE(anyTie(viewOf(small, trial.box))) << seed;
        ++shrunk;
    }
}

TEST(Shrink, WhatHoldsOfOneTriangleIsShrunkToIt) {
    const Trial trial = trialOf(3);
    ASSERT_GT(trial.scene.triangles.size(), 3u);
    const glm::vec3 corner = trial.scene.triangles[2].p_world[1];
    const WorldScene small = shrink(trial.scene, [&](const WorldScene& scene) {
        return std::ranges::any_of(scene.triangles, [&](const WorldTriangle& t) {
            return std::ranges::find(t.p_world, corner) != t.p_world.end();
        });
    });
    ASSERT_EQ(small.triangles.size(), 1u);
    EXPECT_EQ(bitsOf(small),
              significantBits(corner.x) + significantBits(corner.y) + significantBits(corner.z));
}

TEST(Shrink, TheBudgetIsKept) {
    int asked = 0;
    shrink(
        trialOf(1).scene, [&](const WorldScene&) { return ++asked, true; }, 7);
    EXPECT_EQ(asked, 7);
}

TEST(Shrink, TheSavedFileFailsAgain) {
    const Property property{"NoTwoTrianglesTie", noTwoTrianglesTie};
    std::uint64_t seed = 1;
    while (!noTwoTrianglesTie(trialOf(seed)).wrong) ++seed;
    const Trial trial = trialOf(seed);
    const std::string report = reportFailure(property, trial);
    const std::string file = fmt::format("failure-NoTwoTrianglesTie-{}.gltf", seed);
    EXPECT_NE(report.find("edgewise weights " + file), std::string::npos) << report;
    EXPECT_NE(report.find(fmt::format("EDGEWISE_PROPERTY_SEED={}", seed)), std::string::npos) << report;
    EXPECT_NE(report.find("to 2 triangles"), std::string::npos) << report;
    const View view = viewOf(std::filesystem::path(file), trial.box);
    EXPECT_EQ(view.scene.triangle_count, 2u);
    EXPECT_TRUE(anyTie(view));
    std::filesystem::remove(file);
}

TEST(Shrink, CountsSignificantBits) {
    EXPECT_EQ(significantBits(0.0f), 0);
    EXPECT_EQ(significantBits(-0.25f), 1);
    EXPECT_EQ(significantBits(5.0f), 3);
    EXPECT_EQ(significantBits(std::nextafter(1.0f, 0.0f)), 24);
    EXPECT_EQ(significantBits(0x1p-149f), 1);
}

}  // namespace
}  // namespace edgewise::property
