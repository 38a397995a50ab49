// The performance page's tables from rows made by hand: what they say can be worked out.
#include "paper_figures/performance.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "paper_figures/stage_ideals.h"

namespace edgewise::figures {
namespace {

compare::Row rowOfMethod(const std::string& method, std::vector<double> seconds) {
    compare::Row row;
    row.method = method, row.filter = "box", row.radius = 0.5, row.size = {100, 50};
    row.seconds = std::move(seconds);
    row.setup_seconds.assign(row.seconds.size(), 0.0);
    return row;
}

SceneTimes someScene() {
    SceneTimes times;
    times.scene = {"a", "a", "box", 0.5, 100, 50, "rt:4", "rt:1", ""};
    compare::Row nsaa = rowOfMethod("nsaa", {0.9, 0.2, 0.3});
    nsaa.stages = {{"weights", {0.1, 0.2, 0.3}}, {"blend", {0.01}}};
    nsaa.counts = {{"terms", 1000}, {"segments", 10}, {"pixel_owner_pairs", 100}};
    times.comparison.rows = {nsaa, rowOfMethod("rt:4", {0.6, 0.5, 0.7}), rowOfMethod("rt:1", {0.15, 0.15})};
    return times;
}

Performance someFigure() {
    Performance found;
    found.rates = {1e9, 1e6, "sse2"};
    found.scenes = {someScene()};
    GrowthSeries series{"torus", "nsaa", true, {}};
    for (const double x : {10.0, 100.0, 1000.0}) {
        GrowthPoint point{x, rowOfMethod("nsaa", {2 * x})};
        point.row.stages = {{"project", {x * x}}, {"plan", {0.0}}};
        series.points.push_back(point);
    }
    found.growth = {series};
    return found;
}

TEST(PerformanceBars, AreMediansOfTheRun) {
    const Performance found = someFigure();
    const auto rows = barRows(found);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].nsaa_seconds, 0.3);
    EXPECT_EQ(rows[0].at_most.seconds, 0.6);
    EXPECT_DOUBLE_EQ(*rows[0].at_most.ratio, 0.5);
    EXPECT_TRUE(rows[0].at_most.met());
    EXPECT_DOUBLE_EQ(*rows[0].aim.ratio, 2.0);
    EXPECT_FALSE(rows[0].aim.met());
}

TEST(PerformanceBars, WithoutAPeerThereIsNoVerdict) {
    Performance found = someFigure();
    found.scenes[0].comparison.rows[1].seconds.clear();
    found.scenes[0].comparison.rows.pop_back();
    const auto rows = barRows(found);
    for (const Bar& bar : {rows[0].at_most, rows[0].aim}) {
        EXPECT_FALSE(bar.seconds);
        EXPECT_FALSE(bar.ratio);
        EXPECT_FALSE(bar.met());
    }
    EXPECT_NE(barsCsv(found).find("a,0.3,rt:4,,,,rt:1,,,\n"), std::string::npos) << barsCsv(found);
}

TEST(PerformanceIdeals, AreTheLargerOfTrafficAndArithmetic) {
    const Performance found = someFigure();
    const auto distances = stageDistances(found.scenes[0].comparison.rows[0], found.rates);
    ASSERT_EQ(distances.size(), 2u);  // the stages that ran
    // 1000 terms of 13 flops; 10 segments of 88 bytes, 100 owners of 16
    EXPECT_EQ(distances[0].stage, "weights");
    EXPECT_DOUBLE_EQ(distances[0].flops, 1000 * flopsPerTerm("box", 0.5));
    EXPECT_DOUBLE_EQ(distances[0].bytes, 10 * 88 + 100 * 16);
    EXPECT_FALSE(distances[0].memory_bound);
    EXPECT_DOUBLE_EQ(distances[0].ideal_seconds, distances[0].flops / 1e6);
    EXPECT_DOUBLE_EQ(distances[0].distance(), 0.2 / distances[0].ideal_seconds);
    // 100 owners of 16 bytes, 5000 pixels of 36, 8 flops an owner
    EXPECT_DOUBLE_EQ(distances[1].bytes, 100 * 16 + 5000 * 36);
    EXPECT_DOUBLE_EQ(distances[1].ideal_seconds, 800 / 1e6);
    EXPECT_GT(flopsPerTerm("gaussian", 2.0), flopsPerTerm("box", 0.5));
}

TEST(PerformanceIdeals, UnitsAreNanosecondsOfTheStage) {
    const SceneTimes times = someScene();
    for (const UnitCost& unit : unitCosts(times.comparison.rows[0])) {
        if (unit.count != "terms") continue;
        EXPECT_DOUBLE_EQ(unit.nanoseconds, 1e9 * 0.2 / 1000);
        return;
    }
    FAIL() << "no terms";
}

TEST(PerformanceGrowth, HasAnExponentAStage) {
    const Performance found = someFigure();
    const auto json = nlohmann::json::parse(performanceJson(found));
    const auto& fits = json.at("growth")[0].at("fits");
    EXPECT_NEAR(fits.at("total").at("exponent"), 1.0, 1e-12);
    EXPECT_NEAR(fits.at("project").at("exponent"), 2.0, 1e-12);
    EXPECT_TRUE(fits.at("plan").is_null());  // it took no time that could be told
    EXPECT_NE(growthCsv(found).find("torus,nsaa,triangles,project,100,10000,"), std::string::npos);
}

TEST(PerformanceTables, HaveEveryRow) {
    const Performance found = someFigure();
    const std::string csv = performanceCsv(found), tex = barsLatex(found);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
    EXPECT_NE(tex.find("a & 300.0 & rt:4 & 600.0 & 0.50 & rt:1 & 150.0 & 2.00"), std::string::npos) << tex;
}

TEST(MachineRates, AreMeasured) {
    const MachineRates rates = measureMachine(1 << 12, 1);
    EXPECT_GT(rates.bytes_per_second, 0.0);
    EXPECT_GT(rates.flops_per_second, 0.0);
    EXPECT_FALSE(rates.instruction_set.empty());
}

}  // namespace
}  // namespace edgewise::figures
