// The whole visible map against the oracle's, face by face, on every kind of hard scene; and maps made wrong
// on purpose, which have to be found out.
#include "pipeline/judge/map_comparison.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "analytic/visibility.h"
#include "pipeline/judge/map_owners.h"
#include "tests/witness/hard_cases.h"
#include "tests/witness/random_scenes.h"
#include "tests/witness/scene_builder.h"

namespace edgewise {
namespace {

using judge::MapReport;
using witness::HardCases;
using witness::RandomScene;
using witness::SceneKind;

exact::Region boxAround(glm::ivec2 c, int reach) {
    return {double(c.x - reach), double(c.y - reach), double(c.x + reach), double(c.y + reach)};
}

Window windowOf(const exact::Region& box) {
    return {int(box.x0) - 1, int(box.y0) - 1, int(box.x1) + 1, int(box.y1) + 1};
}

/// The order of two lines in a slab is decided by abscissae that carry five roundings each, of at most 2^-50
/// px in a cell of 16 px: what lies between closer lines may be exchanged, along both axes. px a px of the
/// box.
constexpr double kOrderShare = 2 * 5 * 0x1p-50 * 2;

MapReport judged(const RandomScene& random, int reach) {
    const exact::Region box = boxAround(random.centre, reach);
    return judge::compareMaps(random.scene, exact::visibleFaces(random.scene, box),
                              visibleMap(random.scene, windowOf(box)), box);
}

/// Hard cases that scenes of a kind have to have shown, in all.
std::vector<std::size_t HardCases::*> promisedBy(SceneKind kind) {
    static const std::map<SceneKind, std::vector<std::size_t HardCases::*>> promised = {
        {SceneKind::kPiercing, {&HardCases::piercing_pairs}},
        {SceneKind::kCyclic, {&HardCases::depth_cycles}},
        {SceneKind::kClosedMesh, {&HardCases::shared_sides}},
        {SceneKind::kClosedMeshBothSides, {&HardCases::shared_sides}},
        {SceneKind::kFan, {&HardCases::corners_on_samples}},
        {SceneKind::kTJunctions, {&HardCases::t_junctions}},
        {SceneKind::kCoplanarDuplicates, {&HardCases::coplanar_overlaps}},
        {SceneKind::kSlivers, {&HardCases::slivers}},
        {SceneKind::kAxisAligned, {&HardCases::horizontal, &HardCases::on_pixel_borders}},
        {SceneKind::kNearCoincident, {&HardCases::near_coincident_pairs, &HardCases::piercing_pairs}},
        {SceneKind::kTiny, {&HardCases::tiny}},
        {SceneKind::kHuge, {&HardCases::huge, &HardCases::piercing_pairs}},
        {SceneKind::kStar, {&HardCases::largest_fan}},
        {SceneKind::kMixed, {&HardCases::piercing_pairs, &HardCases::near_coincident_pairs}}};
    return promised.at(kind);
}

class MapComparison : public testing::TestWithParam<SceneKind> {
  protected:
    /// Scenes of seeds 1 .. `seeds`, magnified, in a square of `reach` px around their centres.
    void judgeSeeds(std::uint64_t seeds, int factor, int reach, int star_edges) {
        MapReport all;
        HardCases met;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const RandomScene random = magnified(makeRandomScene(GetParam(), seed, star_edges), factor);
            const MapReport report = judged(random, reach);
            EXPECT_EQ(report.ownership_errors, 0u) << "seed " << seed << ": " << report.first;
            EXPECT_LE(report.max_area_error_px2, report.area_bound_px2) << "seed " << seed;
            EXPECT_LE(report.small_wrong_area_px2, kOrderShare * 2 * reach) << "seed " << seed;
            all.add(report);
            if (factor == 1) met += witness::countHardCases(random.scene);
        }
        print(all, seeds, reach);
        EXPECT_GE(all.faces_with_disk, 3 * seeds);
        EXPECT_GT(all.points, 20 * seeds);
        EXPECT_EQ(all.unsure_faces, 0u);
        if (tiesArePromised()) {
            EXPECT_GT(all.tied_faces, seeds);
        }
        if (factor > 1) return;
        for (const auto member : promisedBy(GetParam())) EXPECT_GT(met.*member, 0u);
    }

  private:
    static bool tiesArePromised() {
        return GetParam() == SceneKind::kCoplanarDuplicates || GetParam() == SceneKind::kTJunctions;
    }

    static void print(const MapReport& r, std::uint64_t seeds, int reach) {
        fmt::print(
            "{}, seeds 1 to {}, {} px wide: {} faces ({} tied), {} with a disk, {} small of {:.1e} px2 (of "
            "these {} "
            "of {:.1e} px2 are shown otherwise), {} points, worst area {:.1e} of {:.1e} px2\n",
            nameOf(GetParam()), seeds, 2 * reach, r.faces, r.tied_faces, r.faces_with_disk, r.small_faces,
            r.small_area_px2, r.small_wrong.size(), r.small_wrong_area_px2, r.points, r.max_area_error_px2,
            r.area_bound_px2);
    }
};

TEST_P(MapComparison, OwnersAndAreasAreTheOracles) {
    judgeSeeds(8, 1, 4, 60);
}

TEST_P(MapComparison, LargeWindowsToo) {
    judgeSeeds(2, 8, 32, 60);
}

TEST_P(MapComparison, NightlyManyScenes) {
    judgeSeeds(GetParam() == SceneKind::kStar ? 20 : 300, 1, 4, 400);
    judgeSeeds(GetParam() == SceneKind::kStar ? 10 : 100, 8, 32, 200);
}

INSTANTIATE_TEST_SUITE_P(Exact, MapComparison, testing::ValuesIn(witness::allSceneKinds()),
                         [](const auto& one) { return nameOf(one.param); });

/// A triangle over a part of another, and a speck over that: a thousandth of the area's bound, but 32 disks
/// wide.
struct Layers {
    static constexpr double kSpeckPx = 32 * judge::kDiskPx;
    ScreenScene scene;
    exact::Region box{0, 0, 8, 8};
    VisibleMap map;

    Layers() {
        witness::SceneBuilder builder;
        for (const double depth : {1.0, 2.0, 3.0}) builder.addPlane(DepthPlane{0, 0, depth});
        builder.addOnPlane({glm::dvec2{1, 1}, {7, 1.5}, {2, 7}}, 0);
        builder.addOnPlane({glm::dvec2{2, 2}, {4, 2.25}, {2.5, 4}}, 1);
        builder.addOnPlane({glm::dvec2{4.5, 2.5}, {4.5 + kSpeckPx, 2.5}, {4.5, 2.5 + kSpeckPx}}, 2);
        scene = builder.scene();
        map = visibleMap(scene, windowOf(box));
    }
    MapReport report() const { return judge::compareMaps(scene, exact::visibleFaces(scene, box), map, box); }
    void forget(Owner owner) {
        std::erase_if(map.segments,
                      [=](const VisibleSegment& s) { return s.left == owner || s.right == owner; });
    }
};

TEST(WrongMaps, TheRightOneIsFoundRight) {
    const MapReport report = Layers().report();
    EXPECT_TRUE(report.good()) << report.first;
    EXPECT_EQ(report.faces, 3u);
    EXPECT_EQ(report.faces_with_disk, 3u);
}

TEST(WrongMaps, ExchangedOwnersAreFound) {
    Layers layers;
    for (VisibleSegment& s : layers.map.segments)
        for (Owner* owner : {&s.left, &s.right})
            if (*owner < 2) *owner = 1 - *owner;
    EXPECT_GT(layers.report().ownership_errors, 0u);
    EXPECT_GT(layers.report().max_area_error_px2, 0.1);
}

TEST(WrongMaps, AMissingSegmentIsFound) {
    Layers layers;
    for (std::size_t i = 0; i < layers.map.segments.size(); ++i) {
        Layers holed;
        holed.map.segments.erase(holed.map.segments.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_GT(holed.report().ownership_errors, 0u) << "segment " << i;
    }
}

TEST(WrongMaps, AMovedEndIsFoundByTheArea) {
    Layers layers;
    std::size_t ends = 0;
    for (VisibleSegment& s : layers.map.segments)
        for (FinePoint* p : {&s.a, &s.b})
            if (p->grid == glm::dvec2{4, 2.25}) p->grid.x += judge::kDiskPx, ++ends;
    EXPECT_EQ(ends, 2u);
    EXPECT_GT(layers.report().max_area_error_px2, layers.report().area_bound_px2);
}

TEST(WrongMaps, ASpeckLeftOutIsFoundByItsOwner) {
    Layers layers;
    layers.forget(2);
    const MapReport report = layers.report();
    EXPECT_LT(report.max_area_error_px2, 0.1 * report.area_bound_px2);
    EXPECT_GT(report.ownership_errors, 0u);
    EXPECT_NE(report.first.find("0 instead of 2"), std::string::npos) << report.first;
}

TEST(WrongMaps, ASpeckMadeUpIsFoundByItsOwner) {
    Layers layers;
    layers.scene.triangles.pop_back();
    const MapReport report = layers.report();
    EXPECT_LT(report.max_area_error_px2, 0.1 * report.area_bound_px2);
    EXPECT_GT(report.ownership_errors, 0u);
    EXPECT_NE(report.first.find("2 instead of 0"), std::string::npos) << report.first;
}

/// Over another triangle, a right-angled or nearly right-angled one along (4, 3) px from (1, 1), whose short
/// side is this many steps of the grid. Four are a disk; both axes' chords are longer than one.
struct Sliver {
    static constexpr double kStepPx = 0x1p-32;
    ScreenScene scene;
    exact::Region box{0, 0, 8, 8};
    VisibleMap map;

    explicit Sliver(glm::dvec2 short_side_steps, double left_px = 0) {
        witness::SceneBuilder builder;
        for (const double depth : {1.0, 2.0}) builder.addPlane(DepthPlane{0, 0, depth});
        builder.addOnPlane({glm::dvec2{-20, -20}, {40, -20}, {-20, 40}}, 0);
        builder.addOnPlane({glm::dvec2{1, 1}, {5, 4}, glm::dvec2(1) + kStepPx * short_side_steps}, 1);
        scene = builder.scene();
        box.x0 = left_px;
        map = visibleMap(scene, windowOf(box));
    }
    MapReport report() const { return judge::compareMaps(scene, exact::visibleFaces(scene, box), map, box); }
};

void expectOneSmallFace(const MapReport& report) {
    EXPECT_TRUE(report.good()) << report.first;
    EXPECT_EQ(report.faces, 2u);
    EXPECT_EQ(report.small_faces, 1u);
    EXPECT_EQ(report.unsure_faces, 0u);
}

TEST(MapComparisonSlivers, ASlantedOneThinnerThanTheDiskIsProvenToHaveNone) {
    expectOneSmallFace(Sliver({-1, 4}).report());  // (4 * 4 + 3 * 1) / 5 = 3.8 steps high
}

TEST(MapComparisonSlivers, WhatIsWideOutsideTheBoxIsSmallInIt) {
    expectOneSmallFace(Sliver({-3, 4}, 2).report());  // 5 steps at x = 1, 3.75 at x = 2
}

TEST(MapComparisonSlivers, ASlantedOneThickerThanTheDiskIsAskedAtItsWideEnd) {
    Sliver sliver({-3, 3});  // 4.2 steps high
    const MapReport report = sliver.report();
    EXPECT_TRUE(report.good()) << report.first;
    EXPECT_EQ(report.faces_with_disk, 2u);
    EXPECT_EQ(report.small_faces, 0u);
    sliver.map.segments.clear();  // all of them are the sliver's
    const MapReport wrong = sliver.report();
    EXPECT_GT(wrong.ownership_errors, 0u);
    EXPECT_NE(wrong.first.find("0 instead of 1"), std::string::npos) << wrong.first;
}

/// A triangle and a nearer copy of it leave a wedge of two thin arms: moved inwards, its outer sides still
/// surround the copy, which is none of the wedge.
TEST(MapComparisonSlivers, ABentOneIsNotAskedBetweenItsArms) {
    witness::SceneBuilder builder;
    for (const double depth : {1.0, 2.0}) builder.addPlane(DepthPlane{0, 0, depth});
    const glm::dvec2 moved = Sliver::kStepPx * glm::dvec2(5, 8);
    builder.addOnPlane({glm::dvec2{1, 1}, {5, 4}, {2, 6}}, 0);
    builder.addOnPlane({glm::dvec2{1, 1} + moved, glm::dvec2{5, 4} + moved, glm::dvec2{2, 6} + moved}, 1);
    const exact::Region box{0, 0, 8, 8};
    const MapReport report = judge::compareMaps(builder.scene(), exact::visibleFaces(builder.scene(), box),
                                                visibleMap(builder.scene(), windowOf(box)), box);
    EXPECT_TRUE(report.good()) << report.first;
    EXPECT_EQ(report.small_faces, 1u);
    EXPECT_EQ(report.unsure_faces, 1u);  // not convex: its disks may be missed, and it says so
}

/// Its side cuts a corner off the box; all its own corners lie outside.
TEST(MapComparisonPoints, AFaceInACornerOfTheBoxIsAsked) {
    witness::SceneBuilder builder;
    builder.addPlane(DepthPlane{0, 0, 1});
    builder.addOnPlane({glm::dvec2{-10, -10}, {10.5, -10}, {-10, 10.5}}, 0);
    const exact::Region box{0, 0, 8, 8};
    const MapReport report = judge::compareMaps(builder.scene(), exact::visibleFaces(builder.scene(), box),
                                                visibleMap(builder.scene(), windowOf(box)), box);
    EXPECT_TRUE(report.good()) << report.first;
    EXPECT_EQ(report.faces_with_disk, 1u);
    EXPECT_EQ(report.small_faces, 0u);
}

VisibleSegment uprightAt(FinePoint top, Owner left, Owner right) {
    VisibleSegment s;
    s.a = top, s.b = top, s.b.grid.y += 8;
    s.left = left, s.right = right;
    return s;
}

TEST(MapOwners, WallsThatRoundingExchangedCountTogether) {
    VisibleMap map;
    map.segments = {uprightAt({{1, 0}, {0, 0}}, 4, 5), uprightAt({{1, 0}, {-0x1p-74, 0}}, 5, 6)};
    const judge::MapOwners owners(map);
    const FinePoint before{{0.5, 4}, {0, 0}}, behind{{2, 4}, {0, 0}};
    EXPECT_TRUE(owners.confirmed(before, 4, false, judge::kDiskPx));
    EXPECT_TRUE(owners.confirmed(behind, 6, false, judge::kDiskPx));
    for (const Owner other : {5u, 6u}) EXPECT_FALSE(owners.confirmed(before, other, false, judge::kDiskPx));
    EXPECT_FALSE(owners.confirmed(before, 4, false, 0));  // alone, the nearer one says 5
}

}  // namespace
}  // namespace edgewise
