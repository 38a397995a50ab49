// The random scenes keep the rules of ScreenScene and hold what their names promise.
#include "tests/witness/random_scenes.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "tests/witness/hard_cases.h"
#include "tests/witness/scanline_quadrature.h"
#include "tests/witness/scene_builder.h"

namespace edgewise::witness {
namespace {

constexpr std::uint64_t kSeeds = 12;

class EveryScene : public testing::TestWithParam<SceneKind> {};

TEST_P(EveryScene, KeepsTheRules) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const RandomScene random = makeRandomScene(GetParam(), seed);
        ASSERT_FALSE(random.scene.triangles.empty()) << "seed " << seed;
        for (const ScreenTriangle& t : random.scene.triangles) {
            ASSERT_LT(t.plane, random.scene.planes.size());
            ASSERT_GT(orientation(t.p_px[0], t.p_px[1], t.p_px[2]), 0) << "seed " << seed;
            for (glm::dvec2 p : t.p_px) {
                ASSERT_EQ(p.x, toGrid(p.x)) << "seed " << seed;
                ASSERT_EQ(p.y, toGrid(p.y)) << "seed " << seed;
                ASSERT_LE(std::max(std::fabs(p.x), std::fabs(p.y)), kGuardBandPx) << "seed " << seed;
            }
        }
        for (std::size_t k = 1; k < random.scene.triangles.size(); ++k)
            ASSERT_LE(random.scene.triangles[k - 1].owner, random.scene.triangles[k].owner);
    }
}

TEST_P(EveryScene, HoldsItsHardCases) {
    HardCases met;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
        met += countHardCases(makeRandomScene(GetParam(), seed).scene);
    fmt::print("{}, seeds 1 to {}: {}\n", nameOf(GetParam()), kSeeds, toString(met));
    using Member = std::size_t HardCases::*;
    const std::map<SceneKind, std::vector<Member>> promised = {
        {SceneKind::kPiercing, {&HardCases::piercing_pairs}},
        {SceneKind::kCyclic, {&HardCases::depth_cycles, &HardCases::shared_sides}},
        {SceneKind::kClosedMesh, {&HardCases::shared_sides}},
        {SceneKind::kClosedMeshBothSides, {&HardCases::shared_sides}},
        {SceneKind::kFan, {&HardCases::corners_on_samples, &HardCases::shared_sides}},
        {SceneKind::kTJunctions, {&HardCases::t_junctions, &HardCases::shared_sides}},
        {SceneKind::kCoplanarDuplicates, {&HardCases::coplanar_overlaps}},
        {SceneKind::kSlivers, {&HardCases::slivers}},
        {SceneKind::kAxisAligned,
         {&HardCases::horizontal, &HardCases::vertical, &HardCases::on_pixel_borders,
          &HardCases::through_samples, &HardCases::corners_on_samples}},
        {SceneKind::kNearCoincident, {&HardCases::near_coincident_pairs, &HardCases::piercing_pairs}},
        {SceneKind::kTiny, {&HardCases::tiny}},
        {SceneKind::kHuge, {&HardCases::huge, &HardCases::piercing_pairs}},
        {SceneKind::kStar, {&HardCases::largest_fan, &HardCases::corners_on_samples}},
        {SceneKind::kMixed,
         {&HardCases::piercing_pairs, &HardCases::near_coincident_pairs, &HardCases::slivers,
          &HardCases::horizontal, &HardCases::corners_on_samples}}};
    for (Member member : promised.at(GetParam())) EXPECT_GE(met.*member, 10u);
}

TEST_P(EveryScene, IsJudgedToItsTarget) {
    Real worst_error = 0, worst_sum = 0, worst_swap = 0, slowest = 0;
    std::size_t owners = 0, pieces = 0;
    const std::vector<Prefilter> filters = allPrefilters();
    for (const char* name : {"box", "gaussian", "bspline"}) {
        const auto filter =
            std::find_if(filters.begin(), filters.end(), [&](const auto& f) { return f.name == name; });
        const ScanlineQuadrature quadrature(kernelLike(*filter));
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            const RandomScene random = makeRandomScene(GetParam(), seed, 40);
            const glm::dvec2 sample = glm::dvec2(random.centre) + 0.5;
            const auto begin = std::chrono::steady_clock::now();
            const Judgement judged = quadrature.judge(random.scene, sample);
            const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
            const Judgement swapped = quadrature.judge(swapAxes(random.scene), {sample.y, sample.x});
            for (const auto& [owner, w] : judged.weight) {
                const Real difference = std::fabs(w - swapped.of(owner));
                EXPECT_LE(difference, judged.error + swapped.error)
                    << name << " seed " << seed << " owner " << owner;
                worst_swap = std::max(worst_swap, difference);
                owners += w != 0;
            }
            worst_error = std::max(worst_error, judged.error);
            worst_sum = std::max(worst_sum, std::fabs(judged.sum() - 1));
            slowest = std::max(slowest, Real(seconds.count()));
            pieces = std::max(pieces, judged.pieces);
        }
    }
    fmt::print(
        "{}: estimate <= {:.1e}, |sum - 1| <= {:.1e}, |swap| <= {:.1e}, {} owners, <= {} pieces, slowest "
        "{:.0f} ms\n",
        nameOf(GetParam()), double(worst_error), double(worst_sum), double(worst_swap), owners, pieces,
        double(slowest) * 1e3);
    EXPECT_LT(worst_error, 1e-13L);
}

INSTANTIATE_TEST_SUITE_P(Witness, EveryScene, testing::ValuesIn(allSceneKinds()),
                         [](const auto& one) { return nameOf(one.param); });

}  // namespace
}  // namespace edgewise::witness
