// Fronts and means from rows made by hand: what they say can be worked out.
#include "paper_figures/error_time.h"

#include <gtest/gtest.h>

namespace edgewise::figures {
namespace {

compare::Row rowOfMethod(const std::string& method, double seconds, double rmse) {
    compare::Row row = compare::rowOf(parseMethod(method), makePrefilter("box", 0.5, {}));
    row.size = {8, 8};
    row.seconds = {seconds}, row.setup_seconds = {0.0};
    row.error.emplace().rmse = rmse;
    return row;
}

ErrorTime someFigure() {
    ErrorTime found;
    ErrorTimeScene a{SceneKind::kTriangles, {"a", "nsaa", "", "", {}, {}, {}}}, b = a, field = a;
    a.comparison.rows = {rowOfMethod("none", 1.0, 0.4), rowOfMethod("ssaa:2", 4.0, 0.2),
                         rowOfMethod("ssaa:4", 16.0, 0.1), rowOfMethod("nsaa", 8.0, 0.0)};
    b.comparison.scene = "b";
    b.comparison.rows = {rowOfMethod("none", 2.0, 0.1), rowOfMethod("ssaa:2", 32.0, 0.2)};
    b.comparison.rows.push_back(rowOfMethod("nsaa", 4.0, 0.0));
    b.comparison.rows.back().seconds.clear();  // it failed
    field.kind = SceneKind::kField, field.comparison.scene = "f";
    field.comparison.rows = {rowOfMethod("none", 1.0, 0.4), rowOfMethod("ctss", 1.5, 0.3)};
    found.scenes = {a, b, field};
    return found;
}

TEST(ErrorTime, TheFrontIsWhatNothingBeatsInBoth) {
    const ErrorTime found = someFigure();
    EXPECT_EQ(onFront(found.scenes[0].comparison.rows), (std::vector<bool>{true, true, false, true}));
    EXPECT_EQ(onFront(found.scenes[1].comparison.rows), (std::vector<bool>{true, false, false}));
    // whoever is as good in one thing is not beaten
    EXPECT_EQ(onFront({rowOfMethod("none", 1.0, 0.1), rowOfMethod("fxaa", 1.0, 0.2)}),
              (std::vector<bool>{true, true}));
}

TEST(ErrorTime, MeansAreGeometricAndOfTheirKind) {
    const auto means = methodMeans(someFigure(), SceneKind::kTriangles);
    ASSERT_EQ(means.size(), 4u);
    EXPECT_EQ(means[1].method, "ssaa:2");
    EXPECT_EQ(means[1].family, means[2].family);
    EXPECT_EQ(means[1].scenes, 2u);
    EXPECT_EQ(means[1].fronts, 1u);
    EXPECT_DOUBLE_EQ(means[1].time_ratio, 8.0);    // 4 and 16
    EXPECT_DOUBLE_EQ(*means[1].error_ratio, 1.0);  // 1/2 and 2
    EXPECT_EQ(means[3].scenes, 1u);                // nsaa failed on b
    EXPECT_FALSE(means[3].error_ratio);
    const auto fields = methodMeans(someFigure(), SceneKind::kField);
    ASSERT_EQ(fields.size(), 2u);
    EXPECT_DOUBLE_EQ(fields[1].time_ratio, 1.5);
}

TEST(ErrorTime, EveryRowAndEverySceneIsThere) {
    const ErrorTime found = someFigure();
    const std::string csv = errorTimeCsv(found), means = meansCsv(found);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4 + 3 + 2);
    EXPECT_NE(means.find("SDF scenes,ctss,1,1.5,"), std::string::npos) << means;
    const auto plots = errorTimePlots(found);
    ASSERT_EQ(plots.size(), 5u);  // two of means, three scenes
    EXPECT_EQ(plots[4].name, "pareto-f");
}

}  // namespace
}  // namespace edgewise::figures
