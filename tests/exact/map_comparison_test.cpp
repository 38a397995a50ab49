// The whole visible map against the oracle's, face by face, on every kind of hard scene.
#include "pipeline/judge/map_comparison.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <chrono>

#include "analytic/visibility.h"
#include "tests/witness/hard_cases.h"
#include "tests/witness/random_scenes.h"

namespace edgewise {
namespace {

using witness::RandomScene;
using witness::SceneKind;

constexpr std::uint64_t kSeeds = 3;
constexpr int kReachPx = 4;

class MapComparison : public testing::TestWithParam<SceneKind> {};

TEST_P(MapComparison, OwnersAndAreasAreTheOracles) {
    judge::MapReport all;
    double times[2] = {0,0};
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const RandomScene random = makeRandomScene(GetParam(), seed);
        const glm::ivec2 c = random.centre;
        const Window window{c.x - kReachPx, c.y - kReachPx, c.x + kReachPx, c.y + kReachPx};
        const exact::Region box{double(window.x0), double(window.y0), double(window.x1), double(window.y1)};
        const VisibleMap map = visibleMap(random.scene, window);
        auto t0 = std::chrono::steady_clock::now();
        const auto faces = exact::visibleFaces(random.scene, box);
        auto t1 = std::chrono::steady_clock::now();
        const judge::MapReport report = judge::compareMaps(random.scene, faces, map, box);
        auto t2 = std::chrono::steady_clock::now();
        times[0] += std::chrono::duration<double>(t1-t0).count();
        times[1] += std::chrono::duration<double>(t2-t1).count();
        EXPECT_EQ(report.ownership_errors, 0u) << "seed " << seed << ": " << report.first;
        EXPECT_LE(report.max_area_error_px2, report.area_bound_px2) << "seed " << seed;
        all.add(report);
    }
    fmt::print("{}: {} faces ({} tied), {} with a disk, {} small ({:.1e} px2, {} wrong with {:.1e} px2, {} unsure), "
               "{} points, worst area {:.1e} of {:.1e} px2 {:.2f} {:.2f} s\n",
               nameOf(GetParam()), all.faces, all.tied_faces, all.faces_with_disk, all.small_faces,
               all.small_area_px2, all.small_wrong, all.small_wrong_area_px2, all.unsure_faces, all.points,
               all.max_area_error_px2, all.area_bound_px2, times[0], times[1]);
    EXPECT_GT(all.faces_with_disk, 10u);
    EXPECT_GT(all.points, 100u);
}

INSTANTIATE_TEST_SUITE_P(Exact, MapComparison, testing::ValuesIn(witness::allSceneKinds()),
                         [](const auto& one) { return nameOf(one.param); });

}  // namespace
}  // namespace edgewise
