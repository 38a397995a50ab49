// The atlas is the worst of its rows, and promises that are broken show.
#include "paper_figures/stability_atlas.h"

#include <gtest/gtest.h>

namespace edgewise::figures {
namespace {

judge::StabilityRow row(const std::string& filter, double condition, double of_bound, double of_float_bound) {
    judge::StabilityRow out;
    out.case_name = "slivers", out.filter = filter, out.condition = condition;
    out.bound = 1e-14, out.max_error = 1e-14 * of_bound, out.worst_of_bound = of_bound;
    out.fp32.bound = 4e-6, out.fp32.max_error = 4e-6 * of_float_bound,
    out.fp32.worst_of_bound = of_float_bound;
    return out;
}

TEST(StabilityAtlas, CellsAreTheWorstOfTheirRows) {
    const auto cells =
        atlasCells({row("box", 0.1, 0.2, 0.01), row("box", 0.01, 0.5, 0.001), row("cone", 0.1, 0.3, 0.9)});
    ASSERT_EQ(cells.size(), 2u);
    EXPECT_EQ(cells[0].of_bound, 0.5);
    EXPECT_EQ(cells[0].at, 0.01);
    EXPECT_EQ(cells[0].of_float_bound, 0.01);
    EXPECT_TRUE(cells[0].kept);
    EXPECT_EQ(cells[1].filter, "cone");
    EXPECT_EQ(atlasPlot(cells).svg.find("#d7263d"), std::string::npos);
}

TEST(StabilityAtlas, BrokenPromisesAreRed) {
    const auto beyond = atlasCells({row("box", 0.1, 0.2, 0.01), row("box", 0.01, 1.5, 0.001)});
    EXPECT_FALSE(beyond[0].kept);
    EXPECT_NE(atlasPlot(beyond).svg.find("#d7263d"), std::string::npos);
    judge::StabilityRow wrong = row("box", 0.1, 0.2, 0.01);
    wrong.ownership_errors = 1;
    const auto cells = atlasCells({wrong, row("box", 0.2, 0.1, 0.1)});
    EXPECT_EQ(cells[0].ownership_errors, 1u);
    EXPECT_FALSE(cells[0].kept);
    EXPECT_NE(atlasPlot(cells).svg.find("#d7263d"), std::string::npos);
}

TEST(StabilityAtlas, EveryCaseWithRowsHasAPlot) {
    const auto plots = stabilityPlots({row("box", 0.1, 0.2, 0.01), row("box", 0.01, 0.0, 0.0)});
    ASSERT_EQ(plots.size(), 1u);
    EXPECT_EQ(plots[0].name, "case-slivers");
}

}  // namespace
}  // namespace edgewise::figures
