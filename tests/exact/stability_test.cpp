// The study in small: every case, a few difficulties each, within the promised bounds. `edgewise stability`
// runs all.
#include "pipeline/judge/stability.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "pipeline/error.h"
#include "pipeline/judge/stability_cases.h"
#include "pipeline/judge/stability_report.h"

namespace edgewise::judge {
namespace {

TEST(Stability, EveryCaseStaysWithinItsBound) {
    StabilityOptions options;
    options.filters = {makePrefilter("box", {}, {}), makePrefilter("gaussian", {}, {})};
    options.scenes = 1;
    options.every = 5;
    Progress progress;
    const auto rows = runStability(options, progress);
    std::size_t weights = 0;
    std::uint64_t exact_depths = 0;
    double worst = 0.0, of_bound = 0.0;
    ProjectionErrors seen;
    for (const StabilityRow& row : rows) {
        const std::string where = fmt::format("{} {} at {:g}", row.case_name, row.filter, row.condition);
        EXPECT_LE(row.worst_of_bound, 1.0) << where << ", error " << row.max_error;
        EXPECT_EQ(row.ownership_errors, 0u) << where;
        EXPECT_EQ(row.partition_defect, 0.0) << where;
        EXPECT_EQ(row.label_conflicts, 0u) << where;
        EXPECT_LT(row.oracle_error, 1e-30) << where;
        if (row.projection) {
            EXPECT_LE(row.projection->worst_of_bound, 1.0)
                << where << ", " << row.projection->max_px << " px";
            EXPECT_EQ(row.projection->cracks, 0u) << where;
            EXPECT_EQ(row.projection->lost_areas, 0u) << where;
            seen.add(*row.projection);
        }
        weights += row.weights, exact_depths += row.exact_depths;
        worst = std::max(worst, row.max_error), of_bound = std::max(of_bound, row.worst_of_bound);
    }
    fmt::print("{} rows, {} weights, {} exact depth comparisons, worst error {:.1e}, {:.2f} of its bound\n",
               rows.size(), weights, exact_depths, worst, of_bound);
    fmt::print("{} vertices, {} made by planes, {} shared clipped edges, {} undecided, worst {:.1e} px\n",
               seen.vertices, seen.made, seen.shared_edges, seen.undecided, seen.max_px);
    EXPECT_GT(seen.made, 100u);
    EXPECT_GT(seen.shared_edges, 20u);
    EXPECT_LT(seen.undecided, seen.vertices / 100);
    EXPECT_GE(rows.size(), 2 * stabilityCases().size());
    EXPECT_GT(weights, 200u);
}

TEST(Stability, AnUnknownCaseIsAnInputError) {
    StabilityOptions options;
    options.cases = {"slivers", "marshmallows"};
    Progress progress;
    EXPECT_THROW(runStability(options, progress), InputError);
}

TEST(Stability, ReportsHoldEveryRow) {
    StabilityRow row;
    row.case_name = "slivers", row.filter = "box", row.condition = 1e-3, row.max_error = 2e-16,
    row.bound = 1e-14, row.worst_of_bound = 0.02;
    const std::vector<StabilityRow> rows{row, row};
    const std::string csv = stabilityCsv(rows);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
    EXPECT_NE(stabilityHtml(rows, "a < b").find("a &lt; b"), std::string::npos);
    EXPECT_NE(stabilityLatex(rows).find("slivers & box & 1e-03 & 2.0e-16 & 0.02 & 0 & --"),
              std::string::npos);
    EXPECT_NE(stabilityJson(rows, "x").find("\"max_error\": 2e-16"), std::string::npos);
}

}  // namespace
}  // namespace edgewise::judge
