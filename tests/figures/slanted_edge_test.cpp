// The renderer's own edge against the formulas: neither shares code with the other.
#include "paper_figures/slanted_edge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analytic/filter_properties.h"

namespace edgewise::figures {
namespace {

/// A weight's terms err by 16 u of int |W| (analytic/edge_integral.h), the formula by as much again.
constexpr double kWeightError = 64 * 0x1p-53;

class SlantedEdgeOf : public testing::TestWithParam<const char*> {};

TEST_P(SlantedEdgeOf, MeetsTheFormulas) {
    Progress quiet;
    for (const auto& [p, q] : {std::pair(64, 1), std::pair(64, 63)}) {
        const Prefilter filter = makePrefilter(GetParam(), 1.5, {});
        const FilterProperties properties(filter);
        const SlantedEdge edge = measureEdge(filter, p, q, quiet);
        // every distance is there once, from where the kernel has not begun to where it has ended
        ASSERT_GT(edge.distance.size(), 2 * properties.reach(edge.angle) / edge.spacing_px);
        for (std::size_t k = 0; k + 1 < edge.distance.size(); ++k)
            EXPECT_NEAR(edge.distance[k + 1] - edge.distance[k], edge.spacing_px, 1e-12);
        EXPECT_NEAR(edge.value.front(), 0.0, kWeightError);
        EXPECT_NEAR(edge.value.back(), 1.0, kWeightError);
        for (std::size_t k = 0; k < edge.value.size(); ++k)
            EXPECT_NEAR(edge.value[k], properties.stepResponse(edge.distance[k], edge.angle), kWeightError)
                << k;
        for (double f = 0.0; f <= 2.0; f += 0.0625) {
            const double bound = responseBound(edge, properties.variation(edge.angle), f);
            EXPECT_NEAR(measuredResponse(edge, f), properties.transform(f, edge.angle), bound) << f;
            EXPECT_LT(bound, 0.01);  // or it would say nothing
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Filters, SlantedEdgeOf,
                         testing::Values("box", "disk", "tent", "cone", "gaussian", "gaussian-separable",
                                         "mitchell", "lanczos", "poly:1,-3,3,-1"));

}  // namespace
}  // namespace edgewise::figures
