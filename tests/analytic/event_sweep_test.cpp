// A leaf by its events against the same leaf slab by slab: the same map, bit for bit, on every kind of scene.
#include "analytic/event_sweep.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "analytic/visibility.h"
#include "tests/analytic/window_around.h"
#include "tests/witness/random_scenes.h"

namespace edgewise {
namespace {

using witness::SceneKind;

constexpr std::uint64_t kSeeds = 40;
constexpr int kReachPx = 4;

bool sameLine(const CarrierLine& l, const CarrierLine& m) {
    return l.origin == m.origin && l.nx_hi == m.nx_hi && l.nx_lo == m.nx_lo && l.ny_hi == m.ny_hi &&
           l.ny_lo == m.ny_lo && l.c_hi == m.c_hi && l.c_lo == m.c_lo;
}

void expectSame(const VisibleMap& one, const VisibleMap& two) {
    ASSERT_EQ(one.segments.size(), two.segments.size());
    for (std::size_t i = 0; i < one.segments.size(); ++i) {
        const VisibleSegment &s = one.segments[i], &t = two.segments[i];
        ASSERT_TRUE(samePoint(s.a, t.a) && samePoint(s.b, t.b)) << "segment " << i;
        ASSERT_TRUE(s.left == t.left && s.right == t.right) << "segment " << i;
        ASSERT_TRUE(sameLine(one.lines[s.line], two.lines[t.line])) << "segment " << i;
    }
    ASSERT_EQ(one.row_offset, two.row_offset);
    for (std::size_t i = 0; i < one.rows.size(); ++i)
        ASSERT_TRUE(one.rows[i].x_px == two.rows[i].x_px && one.rows[i].owner == two.rows[i].owner)
            << "row entry " << i;
}

class EventSweepTruth : public testing::TestWithParam<SceneKind> {
  protected:
    /// Events against slabs, in cells of at most `max_triangles`.
    static VisibilityCounts compare(SceneKind kind, int max_triangles) {
        VisibilityCounts counts;
        for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
            const witness::RandomScene random = makeRandomScene(kind, seed);
            const Window window = test::windowAround(random.centre, kReachPx);
            VisibilityOptions by_events, by_slabs;
            by_events.max_triangles = by_slabs.max_triangles = max_triangles;
            by_events.certify = by_slabs.certify = false;  // all cells are swept
            by_slabs.events = false;
            VisibilityCounts slabs;
            SCOPED_TRACE(fmt::format("seed {}", seed));
            expectSame(visibleMap(random.scene, window, by_events, &counts),
                       visibleMap(random.scene, window, by_slabs, &slabs));
            EXPECT_EQ(slabs.by_events, 0u);
        }
        fmt::print("{}, at most {} triangles: {} of {} leaves by events\n", nameOf(kind), max_triangles,
                   counts.by_events, counts.cells);
        return counts;
    }
};

TEST_P(EventSweepTruth, GivesTheMapOfTheSlabs) {
    EXPECT_GT(compare(GetParam(), VisibilityOptions{}.max_triangles).by_events, 0u);
    EXPECT_GT(compare(GetParam(), 3).by_events, 1000u);
}

INSTANTIATE_TEST_SUITE_P(Analytic, EventSweepTruth, testing::ValuesIn(witness::allSceneKinds()),
                         [](const auto& one) { return nameOf(one.param); });

TEST(EventSweep, SweepsWhatIsPlainAndDeclinesWhatTouches) {
    VisibilityCounts plain, touching;
    for (const SceneKind kind : witness::allSceneKinds()) {
        const witness::RandomScene random = makeRandomScene(kind, 1);
        const Window window = test::windowAround(random.centre, kReachPx);
        const bool touches = kind == SceneKind::kTJunctions || kind == SceneKind::kAxisAligned;
        visibleMap(random.scene, window, {}, touches ? &touching : &plain);
    }
    EXPECT_GT(2 * plain.by_events, plain.cells);
    EXPECT_LT(touching.by_events, touching.cells);
}

}  // namespace
}  // namespace edgewise
