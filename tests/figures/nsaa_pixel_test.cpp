// The pixel of NSAA's Figure 1: what is drawn, what the methods give, and areas by hand.
#include "paper_figures/nsaa_pixel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/sample_pattern.h"

namespace edgewise::figures {
namespace {

double weightOf(const std::vector<PixelShare>& shares, const std::string& method, const std::string& filter) {
    for (const PixelShare& share : shares)
        if (share.method == method && share.filter == filter) return share.weight;
    ADD_FAILURE() << method << ", " << filter;
    return NAN;
}

TEST(NsaaPixel, DrawnSamplesAreTheMethods) {
    Progress quiet;
    const std::vector<PixelShare> shares = pixelShares(quiet);
    const std::vector<FlatTriangle> triangles = pixelTriangles();
    int partly = 0;
    for (const int n : {2, 4, 8, 16}) {
        int hits = 0;
        for (const glm::dvec2& offset : standardPattern(n).at_px)
            hits += firstIsSeen(triangles, glm::dvec2(kStudiedPixel) + offset);
        EXPECT_EQ(weightOf(shares, "msaa:" + std::to_string(n), "box"), double(hits) / n) << n;
        partly += hits > 0 && hits < n;
    }
    EXPECT_GE(partly, 2);  // or the figure would show nothing
}

/// The first triangle's upper edge is y = 3 + (x - 1/2)/4; the second one's left edge x = 2.75 + (6.5 - y)
/// 7/18. In the pixel [3, 4]^2 the first is below its edge, and the second hides what is right of the other.
TEST(NsaaPixel, BoxIsTheAreaByHand) {
    Progress quiet;
    const auto left_of = [](double y) { return std::clamp(2.75 + (6.5 - y) * 7.0 / 18.0, 3.0, 4.0); };
    constexpr int kRows = 200000;  // a midpoint sum of a piecewise linear function
    double area = 0.0;
    for (int j = 0; j < kRows; ++j) {
        const double y = 3.0 + (j + 0.5) / kRows;
        const double below =
            std::clamp(0.5 + 4.0 * (y - 3.0), 3.0, 4.0);  // x up to which y is below the edge
        area += std::min(below, left_of(y)) - 3.0;
    }
    // Two kinks err by half a row's slope each, at most 4 in x a row of y.
    EXPECT_NEAR(weightOf(pixelShares(quiet), "nsaa", "box"), area / kRows, 2.0 * 4.0 / kRows / kRows);
}

TEST(NsaaPixel, ManySamplesTendToTheIntegral) {
    Progress quiet;
    const std::vector<PixelShare> shares = pixelShares(quiet);
    const double exact = weightOf(shares, "nsaa", "box");
    // Columns of a lattice that an edge crosses are wrong by less than a cell each: two edges, 16 columns.
    EXPECT_LT(std::abs(weightOf(shares, "ssaa:16", "box") - exact), 2.0 * 16.0 / 256.0 / 2.0);
    EXPECT_GT(weightOf(shares, "nsaa", "gaussian"), 0.0);
    EXPECT_NE(weightOf(shares, "nsaa", "gaussian"), exact);
}

}  // namespace
}  // namespace edgewise::figures
