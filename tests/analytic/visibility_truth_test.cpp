// The visible map against brute-force scanlines, on every kind of scene.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "analytic/visibility.h"
#include "tests/witness/hard_cases.h"
#include "tests/witness/map_scan.h"
#include "tests/witness/random_scenes.h"

namespace edgewise {
namespace {

using witness::RandomScene;
using witness::SceneKind;

constexpr std::uint64_t kSeeds = 20;
constexpr int kReachPx = 3;

Window around(glm::ivec2 pixel, int reach) {
    return {pixel.x - reach, pixel.y - reach, pixel.x + reach + 1, pixel.y + reach + 1};
}

class VisibilityTruth : public testing::TestWithParam<SceneKind> {};

TEST_P(VisibilityTruth, EveryScanlineHasTheRightOwners) {
    witness::ScanVerdict all;
    VisibilityCounts counts;
    VisibilityOptions options;
    options.check_closure = true;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const RandomScene random = makeRandomScene(GetParam(), seed);
        const VisibleMap map = visibleMap(random.scene, around(random.centre, kReachPx + 1), options, &counts);
        const auto verdict = witness::compareMap(random.scene, map, glm::dvec2(random.centre) + 0.5, kReachPx, seed, 20);
        EXPECT_TRUE(verdict.good()) << "seed " << seed << ": " << verdict.broken << " broken, " << verdict.disagreements
                                    << " wrong, " << verdict.wrong_px2 << " px2, widest " << verdict.widest_px << " px; first: " << verdict.first;
        all.add(verdict);
    }
    fmt::print("{}: {} scanlines, {} crossings, worst offset {:.1e} px, {} exact depth signs, {} depth lines, gap {:.1e}\n",
               nameOf(GetParam()), all.scanlines, all.crossings, double(all.worst_offset_px), counts.exact_depth,
               counts.depth_lines, counts.widest_gap_px);
    EXPECT_GT(all.crossings, 1000u);
}

TEST_P(VisibilityTruth, RowsNameTheOwnersAlongTheSamples) {
    std::size_t asked = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const RandomScene random = makeRandomScene(GetParam(), seed);
        const Window window = around(random.centre, kReachPx);
        const VisibleMap map = visibleMap(random.scene, window);
        for (int y = window.y0; y < window.y1; ++y) {
            const auto row = static_cast<std::size_t>(y - map.row_begin);
            ASSERT_LT(row + 1, map.row_offset.size());
            for (std::size_t k = map.row_offset[row]; k + 1 < map.row_offset[row + 1]; ++k) {
                const double from = map.rows[k].x_px, to = map.rows[k + 1].x_px;
                if (!(to - from > 1e-6)) continue;  // so that the point asked is not on a border by rounding
                const glm::dvec2 p{(from + to) / 2, y + 0.5};
                const Owner above = witness::ownerAt(random.scene, p - glm::dvec2(0, 2 * kGridPx));
                const Owner below = witness::ownerAt(random.scene, p + glm::dvec2(0, 2 * kGridPx));
                if (above != below) continue;  // a border along the row: either owner would do
                EXPECT_EQ(map.rows[k].owner, above) << "seed " << seed << " at " << p.x << ", " << p.y;
                ++asked;
            }
        }
    }
    fmt::print("{}: {} places\n", nameOf(GetParam()), asked);
    EXPECT_GT(asked, 50u);
}

ScreenScene moved(ScreenScene scene, glm::dvec2 by_px) {
    scene.anchor_px += by_px;
    for (ScreenTriangle& t : scene.triangles)
        for (glm::dvec2& p : t.p_px) p += by_px;
    return scene;
}

void expectSame(const VisibleMap& a, const VisibleMap& b, glm::dvec2 by_px) {
    ASSERT_EQ(a.segments.size(), b.segments.size());
    for (std::size_t k = 0; k < a.segments.size(); ++k) {
        const VisibleSegment &s = a.segments[k], &t = b.segments[k];
        EXPECT_EQ(s.a.grid + by_px, t.a.grid);
        EXPECT_EQ(s.b.grid + by_px, t.b.grid);
        EXPECT_EQ(s.a.rest, t.a.rest);
        EXPECT_EQ(s.b.rest, t.b.rest);
        EXPECT_EQ(s.length, t.length);
        EXPECT_EQ(s.left, t.left);
        EXPECT_EQ(s.right, t.right);
        const CarrierLine &l = a.lines[s.line], &m = b.lines[t.line];
        EXPECT_EQ(l.nx_hi, m.nx_hi);
        EXPECT_EQ(l.nx_lo, m.nx_lo);
        EXPECT_EQ(l.ny_hi, m.ny_hi);
        EXPECT_EQ(l.ny_lo, m.ny_lo);
        EXPECT_EQ(l.length, m.length);
    }
}

TEST_P(VisibilityTruth, WholeCellsMoveItExactly) {
    if (GetParam() == SceneKind::kHuge) GTEST_SKIP() << "corners would leave the guard band";
    const glm::dvec2 by(3 * kCellPx, -2 * kCellPx);
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const RandomScene random = makeRandomScene(GetParam(), seed);
        const Window window = around(random.centre, kReachPx);
        const int dx = int(by.x), dy = int(by.y);
        const VisibleMap here = visibleMap(random.scene, window);
        const VisibleMap there = visibleMap(moved(random.scene, by),
                                            {window.x0 + dx, window.y0 + dy, window.x1 + dx, window.y1 + dy});
        expectSame(here, there, by);
        if (HasFailure()) FAIL() << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Analytic, VisibilityTruth, testing::ValuesIn(witness::allSceneKinds()),
                         [](const auto& one) { return nameOf(one.param); });

}  // namespace
}  // namespace edgewise
