#include "paper_figures/cone_table.h"

#include <gtest/gtest.h>

namespace edgewise::figures {
namespace {

TEST(ConeTable, MeansAreOfRatiosAndNotOfTimes) {
    const std::vector<ConeTableRow> rows{{"a", 2, 1, {1.0, 4.0, 1.5, 1.0}, {1.0, 4.5, 1.25, 1.0}},
                                         {"b", 2, 1, {100.0, 200.0, 250.0, 100.0}, {1.0, 3.5, 1.75, 1.0}}};
    EXPECT_DOUBLE_EQ(meanRatio(rows, 1), 3.0);
    EXPECT_DOUBLE_EQ(meanRatio(rows, 2), 2.0);
    EXPECT_DOUBLE_EQ(meanPaper(rows, 1), 4.0);
    EXPECT_DOUBLE_EQ(meanPaper(rows, 2), 1.5);
    EXPECT_NE(coneTableCsv(rows).find("b,2,1,ssaa:2,200,2,3.5\n"), std::string::npos) << coneTableCsv(rows);
}

/// Its times, copied one by one, give the means that it prints, to the digits that it prints.
TEST(ConeTable, ThePapersTimesGiveItsOwnMeans) {
    const auto rows = paperTable();
    ASSERT_EQ(rows.size(), 10u);
    const double printed[]{1.0, 4.16, 1.30, 1.16};
    for (std::size_t m = 0; m < kTableMethods.size(); ++m) {
        EXPECT_NEAR(meanRatio(rows, m), printed[m], 0.005) << kTableMethods[m];
        EXPECT_DOUBLE_EQ(meanRatio(rows, m), meanPaper(rows, m));
    }
}

}  // namespace
}  // namespace edgewise::figures
