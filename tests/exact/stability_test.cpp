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

/// What a study met on its way.
struct Seen {
    std::size_t weights = 0;
    std::uint64_t exact_depths = 0, fine_orders = 0;
    double worst = 0.0, of_bound = 0.0;
    ProjectionErrors projection;
};

void expectProjected(const ProjectionErrors& p, const std::string& where) {
    EXPECT_LE(p.worst_of_bound, 1.0) << where << ", " << p.max_px << " px";
    EXPECT_EQ(p.cracks, 0u) << where;
    EXPECT_EQ(p.lost_areas, 0u) << where;
}

void expectWithinBounds(const StabilityRow& row, Seen& seen) {
    const std::string where = fmt::format("{} {} at {:g}", row.case_name, row.filter, row.condition);
    EXPECT_LE(row.worst_of_bound, 1.0) << where << ", error " << row.max_error;
    EXPECT_EQ(row.ownership_errors, 0u) << where;
    EXPECT_EQ(row.partition_defect, 0.0) << where;
    EXPECT_EQ(row.label_conflicts, 0u) << where;
    EXPECT_LT(row.oracle_error, 1e-30) << where;
    if (row.projection) expectProjected(*row.projection, where), seen.projection.add(*row.projection);
    seen.weights += row.weights;
    seen.exact_depths += row.exact_depths, seen.fine_orders += row.fine_orders;
    seen.worst = std::max(seen.worst, row.max_error);
    seen.of_bound = std::max(seen.of_bound, row.worst_of_bound);
}

/// Runs, prints what was met, and demands that the hard parts were.
std::vector<StabilityRow> expectStable(const StabilityOptions& options) {
    Progress progress;
    const auto rows = runStability(options, progress);
    Seen seen;
    for (const StabilityRow& row : rows) expectWithinBounds(row, seen);
    const ProjectionErrors& p = seen.projection;
    fmt::print(
        "{} rows, {} weights, {} exact depths, {} fine orders, worst error {:.1e}, {:.2f} of its bound\n",
        rows.size(), seen.weights, seen.exact_depths, seen.fine_orders, seen.worst, seen.of_bound);
    fmt::print("{} vertices, {} made by planes, {} shared clipped edges, {} undecided, worst {:.1e} px\n",
               p.vertices, p.made, p.shared_edges, p.undecided, p.max_px);
    EXPECT_GT(seen.weights, 200u);
    EXPECT_GT(seen.exact_depths, 20u);
    EXPECT_GT(seen.fine_orders, 20u);
    EXPECT_GT(p.made, 100u);
    EXPECT_GT(p.shared_edges, 20u);
    EXPECT_LT(p.undecided, p.vertices / 100);
    return rows;
}

TEST(Stability, EveryCaseStaysWithinItsBound) {
    StabilityOptions options;
    options.filters = {makePrefilter("box", {}, {}), makePrefilter("gaussian", {}, {})};
    options.scenes = 1;
    options.every = 5;
    EXPECT_GE(expectStable(options).size(), 2 * stabilityCases().size());
}

/// A support of which the kernel fills a hundredth, or overfills it a hundredfold.
TEST(Stability, SeparableGaussiansOfEverySigmaStayWithinTheirBound) {
    StabilityOptions options;
    options.filters = {makePrefilter("gaussian-separable", {}, {})};
    options.scenes = 1;
    options.cases = {"sigma"};
    Progress progress;
    Seen seen;
    const auto rows = runStability(options, progress);
    for (const StabilityRow& row : rows) expectWithinBounds(row, seen);
    EXPECT_EQ(rows.size(), 5u);  // a decade each, 1e-2 to 1e2
    EXPECT_GT(seen.weights, 10u);
}

/// Hours: every filter of every family, every difficulty, several scenes each.
TEST(StabilityNightly, EveryFilterStaysWithinItsBound) {
    StabilityOptions options;
    for (const char* name : {"box", "disk", "tent", "cone", "gaussian", "gaussian-separable", "bspline",
                             "mitchell", "catmull-rom", "bc:0.2,0.4", "lanczos", "poly:1,-0.5,0.2"})
        options.filters.push_back(makePrefilter(name, {}, {}));
    options.scenes = 8;
    expectStable(options);
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
