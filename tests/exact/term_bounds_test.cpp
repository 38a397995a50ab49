// The bounds that the docstrings promise of terms, over adversarial edges; the nightly run takes a million a
// category.
#include <gtest/gtest.h>

#include "tests/studies/term_bounds/term_bounds.h"

namespace edgewise::study {
namespace {

BoundsOptions smallStudy() {
    return {.edges = 2000, .judged = 4, .seed = 19890731, .categories = {}};
}

const BoundsResult& result() {
    static const BoundsResult measured = measureBounds(smallStudy());
    return measured;
}

TEST(TermBounds, HoldOverAdversarialEdges) {
    for (const BoundsRow& row : result().rows)
        EXPECT_TRUE(row.holds()) << nameOf(row.claim) << ", " << nameOf(row.category) << ": " << row.judged
                                 << " u by " << row.worst_kernel << ", the bound is " << boundOf(row.claim)
                                 << " u";
    std::printf("%s", boundsTable(result()).c_str());
}

TEST(TermBounds, TheProductRoundsTheTermThatWasMeasured) {
    EXPECT_EQ(result().unequal_bits, 0);
}

// Two formulas and two arithmetics that agree to a thousandth of a rounding.
TEST(TermBounds, ScreenAndJudgeAgree) {
    for (const BoundsRow& row : result().rows) {
        if (boundOf(row.claim) > 100) continue;  // only reported: errors of any size
        EXPECT_LT(row.disagreement, 1e-3) << nameOf(row.claim) << ", " << nameOf(row.category);
    }
}

TEST(TermBounds, TheHardSpotsWereMet) {
    long covered[kClaims] = {};
    for (const BoundsRow& row : result().rows) {
        EXPECT_GT(row.hard, smallStudy().edges / 20) << nameOf(row.claim) << ", " << nameOf(row.category);
        covered[static_cast<int>(row.claim)] += row.cases;
    }
    for (int c = 0; c < kClaims; ++c)
        EXPECT_GT(covered[c], smallStudy().edges) << nameOf(static_cast<Claim>(c));
    for (int c = 0; c < kCategories; ++c)
        for (const int family : {0, 1}) EXPECT_GE(result().edges[family][c], smallStudy().edges);
}

}  // namespace
}  // namespace edgewise::study
