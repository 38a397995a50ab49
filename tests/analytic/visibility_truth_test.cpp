// The visible map against brute-force scanlines, on every kind of scene.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <tuple>

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

/// The order of two lines in a slab is decided by abscissae that carry five roundings each, of at most 2^-50
/// px in a cell of 16 px: closer lines may be exchanged, over at most the judged height, along both axes.
constexpr double kOrderArea = 2 * 5 * 0x1p-50 * (2 * kReachPx) * 2;

class VisibilityTruth : public testing::TestWithParam<SceneKind> {};

TEST_P(VisibilityTruth, EveryScanlineHasTheRightOwners) {
    witness::ScanVerdict all;
    VisibilityCounts counts;
    VisibilityOptions options;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const RandomScene random = makeRandomScene(GetParam(), seed);
        const VisibleMap map =
            visibleMap(random.scene, around(random.centre, kReachPx + 1), options, &counts);
        const auto verdict =
            witness::compareMap(random.scene, map, glm::dvec2(random.centre) + 0.5, kReachPx, seed, 20);
        EXPECT_LE(double(verdict.wrong_px2), kOrderArea)
            << "seed " << seed << ": " << verdict.broken << " broken, " << verdict.disagreements
            << " wrong; first: " << verdict.first;
        all.add(verdict);
    }
    fmt::print(
        "{}: {} scanlines, {} crossings, worst offset {:.1e} px, wrong {:.1e} px2 ({} broken), {} exact "
        "depth signs, "
        "{} depth lines, {} closings\n",
        nameOf(GetParam()), all.scanlines, all.crossings, double(all.worst_offset_px), double(all.wrong_px2),
        all.broken, counts.exact_depth, counts.depth_lines, counts.closings);
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

/// Segments in an order that does not depend on where the scene lies.
std::vector<std::size_t> canonicalOrder(const VisibleMap& map) {
    std::vector<std::size_t> order(map.segments.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto key = [&](std::size_t k) {
        const VisibleSegment& s = map.segments[k];
        return std::tuple(s.a.grid.y, s.a.rest.y, s.a.grid.x, s.a.rest.x, s.b.grid.y, s.b.rest.y, s.b.grid.x,
                          s.b.rest.x, s.left, s.right);
    };
    std::sort(order.begin(), order.end(), [&](std::size_t k, std::size_t l) { return key(k) < key(l); });
    return order;
}

/// Bit for bit, but for `by_px` on the grid.
bool same(const FinePoint& p, const FinePoint& q, glm::dvec2 by_px) {
    return p.grid + by_px == q.grid && p.rest == q.rest;
}

bool same(const CarrierLine& l, const CarrierLine& m) {
    return l.nx_hi == m.nx_hi && l.nx_lo == m.nx_lo && l.ny_hi == m.ny_hi && l.ny_lo == m.ny_lo &&
           l.c_hi == m.c_hi && l.c_lo == m.c_lo && l.length == m.length && l.direction == m.direction;
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
        ASSERT_EQ(here.segments.size(), there.segments.size()) << "seed " << seed;
        const std::vector<std::size_t> order = canonicalOrder(here), order_there = canonicalOrder(there);
        for (std::size_t k = 0; k < order.size(); ++k) {
            const VisibleSegment &s = here.segments[order[k]], &t = there.segments[order_there[k]];
            ASSERT_TRUE(same(s.a, t.a, by) && same(s.b, t.b, by)) << "seed " << seed << " segment " << k;
            ASSERT_TRUE(s.length == t.length && s.left == t.left && s.right == t.right) << "seed " << seed;
            ASSERT_TRUE(same(here.lines[s.line], there.lines[t.line])) << "seed " << seed << " segment " << k;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Analytic, VisibilityTruth, testing::ValuesIn(witness::allSceneKinds()),
                         [](const auto& one) { return nameOf(one.param); });

}  // namespace
}  // namespace edgewise
