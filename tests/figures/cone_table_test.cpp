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

}  // namespace
}  // namespace edgewise::figures
