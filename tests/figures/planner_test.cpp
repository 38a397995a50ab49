// What a saving comes to, from rows made by hand.
#include "paper_figures/planner.h"

#include <gtest/gtest.h>

namespace edgewise::figures {
namespace {

compare::Row row(std::vector<double> seconds, std::map<std::string, std::vector<double>> stages = {}) {
    compare::Row out;
    out.method = "nsaa", out.filter = "box", out.size = {8, 8};
    out.seconds = std::move(seconds), out.stages = std::move(stages);
    return out;
}

Planner someFigure() {
    Planner found;
    found.budget_seconds = 30.0;
    PlannerScene triangles{"t", false, row({3.0, 1.0, 2.0}, {{"weights", {1.0}}, {"blend", {0.5}}}), {}};
    triangles.planned.plan = {{"interior", false, "no, \"nowhere\""}, {"cancel", true, "two colours"}};
    triangles.forced = {{"interior", row({5.0}, {{"weights", {1.5}}, {"blend", {3.0}}})},
                        {"cancel", row({2.0})},
                        {"all", row({})}};
    triangles.forced[2].row.status = compare::RowStatus::kTimeout;
    PlannerScene field{"f", true, row({1.0}), {{"prune", row({4.0})}, {"convex", row({1.0})}}};
    field.planned.plan = {{"prune", true, ""}, {"convex", false, ""}};
    found.scenes = {triangles, field};
    return found;
}

TEST(Planner, SavingsAreRatiosOfMedians) {
    const auto savings = savingsOf(someFigure());
    ASSERT_EQ(savings.size(), 5u);
    EXPECT_DOUBLE_EQ(*savings[0].ratio, 2.5);
    EXPECT_EQ(savings[0].stage, "blend");  // 2.5 s gained, weights 0.5
    EXPECT_EQ(savings[0].stage_without, 3.0);
    EXPECT_EQ(savings[0].stage_planned, 0.5);
    EXPECT_FALSE(savings[0].at_least);
    EXPECT_DOUBLE_EQ(*savings[2].ratio, 15.0);  // 30 s were not enough
    EXPECT_TRUE(savings[2].at_least);
}

TEST(Planner, WhatIsLeftOutIsUsedAndSoAreShortcutsThatRun) {
    const auto savings = savingsOf(someFigure());
    EXPECT_TRUE(savings[0].used);
    EXPECT_FALSE(savings[1].used);
    EXPECT_TRUE(savings[3].used);
    EXPECT_FALSE(savings[4].used);
}

TEST(Planner, FailuresHaveNoRatio) {
    Planner found = someFigure();
    found.scenes[0].forced[0].row.seconds.clear();
    found.scenes[0].forced[0].row.status = compare::RowStatus::kFailed;
    EXPECT_FALSE(savingsOf(found)[0].ratio);
    found.scenes[1].planned.seconds.clear();
    EXPECT_FALSE(savingsOf(found)[3].ratio);
    EXPECT_NE(plannerCsv(found).find("t,interior,true,,false,,0,0,\"no, \"\"nowhere\"\"\"\n"),
              std::string::npos)
        << plannerCsv(found);
}

}  // namespace
}  // namespace edgewise::figures
