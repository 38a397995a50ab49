// Every property over random scenes, and the proof that these are hard.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "analytic/exact/visible_faces.h"
#include "pipeline/project.h"
#include "tests/pipeline/tiny_gltf_file.h"
#include "tests/property/run_property.h"
#include "tests/witness/hard_cases.h"
#include "tests/witness/kernels.h"
#include "tests/witness/product_weights.h"

namespace edgewise::property {
namespace {

constexpr int kScenes = 150;

class EveryPicture : public testing::TestWithParam<Property> {};

TEST_P(EveryPicture, Holds) {
    Campaign campaign = campaignOf(kScenes);
    campaign.scenes = std::max(1, campaign.scenes / GetParam().slowness);
    const int asked = runProperty(GetParam(), campaign);
    if (!HasFailure() && campaign.scenes > 20) {
        EXPECT_GT(asked, campaign.scenes / 4);
    }
}

INSTANTIATE_TEST_SUITE_P(Property, EveryPicture, testing::ValuesIn(allProperties()),
                         [](const auto& one) { return one.param.name; });

/// Scenes that once failed, shrunk: each has taught us something.
TEST(PropertyScenes, ThoseThatFailedHold) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(EDGEWISE_KEPT_SCENES)) {
        const WorldScene scene = readWorld(entry.path());
        for (const Prefilter& filter : witness::allPrefilters())
            for (const Property& property : allProperties()) {
                const Outcome outcome = property.check({scene, {13, 13, 18, 18}, filter, count});
                EXPECT_FALSE(outcome.wrong) << entry.path().filename() << " " << filter.name << " "
                                            << property.name << ": " << outcome.wrong->what;
            }
        ++count;
    }
    EXPECT_GT(count, 0u);
}

TEST(PropertyScenes, AreReadBackAsTheyWere) {
    const test::TempFolder folder;
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
        const std::string text = gltfOf(trialOf(seed).scene);
        test::writeFile(folder / "a.gltf", text);
        WorldScene again = readWorld(folder / "a.gltf");
        EXPECT_EQ(gltfOf(again), text) << seed;
    }
}

/// Of all scenes of a campaign.
struct Met {
    witness::HardCases cases;
    VisibilityCounts visibility;
    std::size_t tied_faces = 0, clipped = 0;
};

void note(const Trial& trial, Met& met) {
    const View view = viewOf(trial.scene, trial.box);
    ScreenPieces pieces;
    const ScreenScene screen = project(view.scene, view.camera, view.film, pieces);
    met.clipped += pieces.counts.clipped;
    met.cases += witness::countHardCases(screen);
    const PixelBox& b = trial.box;
    visibleMap(screen, {b.x0 - 4, b.y0 - 4, b.x1 + 4, b.y1 + 4}, {}, &met.visibility);
    for (const exact::Face& face :
         exact::visibleFaces(screen, {double(b.x0), double(b.y0), double(b.x1), double(b.y1)}))
        met.tied_faces += face.tied.size() > 1;
}

TEST(PropertyScenes, MeetTheHardCases) {
    const Campaign campaign{1, kScenes};
    Met met;
    for (int k = 0; k < campaign.scenes; ++k) note(trialOf(campaign.seed + std::uint64_t(k)), met);
    fmt::print("{}\ntied faces {} exact depths {} depth lines {} certified {} hidden {} clipped {}\n",
               toString(met.cases), met.tied_faces, met.visibility.exact_depth, met.visibility.depth_lines,
               met.visibility.certified, met.visibility.hidden, met.clipped);
    EXPECT_GT(met.cases.piercing_pairs, 500u);
    EXPECT_GT(met.cases.depth_cycles, 2u);
    EXPECT_GT(met.cases.shared_sides, 100u);
    EXPECT_GT(met.cases.t_junctions, 30u);
    EXPECT_GT(met.cases.coplanar_overlaps, 80u);
    EXPECT_GT(met.cases.near_coincident_pairs, 200u);
    EXPECT_GT(met.cases.slivers, 50u);
    EXPECT_GT(met.cases.tiny, 80u);
    EXPECT_GT(met.cases.huge, 80u);
    EXPECT_GT(met.cases.through_samples, 4u);
    EXPECT_GT(met.cases.on_pixel_borders, 15u);
    EXPECT_GT(met.cases.corners_on_samples, 15u);
    EXPECT_GT(met.tied_faces, 100u);
    EXPECT_GT(met.visibility.exact_depth, 1000u);
    EXPECT_GT(met.clipped, 30u);
    EXPECT_GT(met.visibility.certified, 10u);
}

}  // namespace
}  // namespace edgewise::property
