// Other hits: which pixels are listed, and as what.
#include "paper_figures/changed_hits.h"

#include <gtest/gtest.h>

#include <cmath>

namespace edgewise::figures {
namespace {

/// Depths of the left half grow by that factor from column to column; nothing is hit on the right.
double rampDepth(const TracedView& view, double growth, double x) {
    return x < view.film.width / 2 ? 5.0 * std::pow(growth, x) : HUGE_VAL;
}

TEST(ChangedHits, AreNamedByWhatLiesAroundThem) {
    const TracedView view("thin", 640, 360);
    const double same = 64.0 * view.pixelRadius(1.0);  // of the depth
    const double growth = 1.0 + 3.0 * same;            // so neighbours in a row are other hits
    FieldSamples before;
    for (int y = 0; y < view.film.height; ++y)
        for (int x = 0; x < view.film.width; ++x) before.depth.push_back(rampDepth(view, growth, x));
    before.depth[view.index(40, 20)] = 1.0;  // a gap or a thing of one pixel
    FieldSamples after = before;
    after.depth[view.index(319, 0)] = HUGE_VAL;                          // beside nothing: a silhouette
    after.depth[view.index(320, 7)] = before.depth[view.index(319, 8)];  // and the reverse, at a corner
    after.depth[view.index(10, 9)] = rampDepth(view, growth, 10.5);      // between the columns' depths
    after.depth[view.index(20, 9)] = rampDepth(view, growth, 25.0);      // no neighbour is so deep
    after.depth[view.index(5, 5)] = HUGE_VAL;                            // a hole in the middle of a surface
    after.depth[view.index(0, 20)] *= 1.0 + 0.9 * same;                  // the same hit
    after.depth[view.index(40, 20)] = 0.5;
    const std::vector<ChangedHit> changed = changedHits(view, before, after);
    ASSERT_EQ(changed.size(), 6u);
    const auto expect = [&](std::size_t i, int x, int y, HitChange kind) {
        EXPECT_EQ(glm::ivec2(changed[i].x, changed[i].y), glm::ivec2(x, y));
        EXPECT_EQ(nameOf(changed[i].kind), std::string(nameOf(kind))) << x << " " << y;
        EXPECT_EQ(changed[i].classic_depth, before.depth[view.index(x, y)]);
        EXPECT_EQ(changed[i].depth, after.depth[view.index(x, y)]);
    };
    expect(0, 319, 0, HitChange::kSilhouette);
    expect(1, 5, 5, HitChange::kAlone);
    expect(2, 320, 7, HitChange::kSilhouette);
    expect(3, 10, 9, HitChange::kGrazing);
    expect(4, 20, 9, HitChange::kAlone);
    expect(5, 40, 20, HitChange::kNarrow);
}

}  // namespace
}  // namespace edgewise::figures
