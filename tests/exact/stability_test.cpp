// The study in small: every case, a few difficulties each, within the promised bounds. `edgewise stability`
// runs all.
#include "pipeline/judge/stability.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "analytic/exact/visible_faces.h"
#include "analytic/visibility.h"
#include "pipeline/error.h"
#include "pipeline/judge/stability_cases.h"
#include "pipeline/judge/stability_report.h"
#include "tests/witness/scene_builder.h"

namespace edgewise::judge {
namespace {

/// What a study met on its way.
struct Seen {
    std::size_t weights = 0;
    std::uint64_t exact_depths = 0, fine_orders = 0;
    double worst = 0.0, of_bound = 0.0;
    double float_worst = 0.0;
    ProjectionErrors projection;
    MapReport maps;
};

void expectProjected(const ProjectionErrors& p, const std::string& where) {
    EXPECT_LE(p.worst_of_bound, 1.0) << where << ", " << p.max_px << " px";
    EXPECT_EQ(p.cracks, 0u) << where;
    EXPECT_EQ(p.lost_areas, 0u) << where;
}

void expectMapped(const MapReport& m, const std::string& where) {
    EXPECT_EQ(m.ownership_errors, 0u) << where << ": " << m.first;
    EXPECT_LE(m.max_area_share, kAreaShare) << where;
}

void expectWithinBounds(const StabilityRow& row, Seen& seen) {
    const std::string where = fmt::format("{} {} at {:g}", row.case_name, row.filter, row.condition);
    EXPECT_LE(row.worst_of_bound, 1.0) << where << ", error " << row.max_error;
    EXPECT_EQ(row.ownership_errors, 0u) << where;
    EXPECT_EQ(row.partition_defect, 0.0) << where;
    EXPECT_EQ(row.label_conflicts, 0u) << where;
    EXPECT_EQ(row.fp32.bound, 64.0 * 0x1p-24) << where;
    EXPECT_LE(row.fp32.worst_of_bound, 1.0) << where << ", fp32 error " << row.fp32.max_error;
    EXPECT_EQ(row.fp32.ownership_errors, 0u) << where << " in fp32";
    EXPECT_EQ(row.fp32.partition_defect, 0.0) << where << " in fp32";
    EXPECT_EQ(row.fp32.label_conflicts, 0u) << where << " in fp32";
    EXPECT_LT(row.oracle_error, 1e-30) << where;
    EXPECT_TRUE(row.map || row.map_left_out == "too many triangles") << where;
    if (row.map) expectMapped(*row.map, where), seen.maps.add(*row.map);
    if (row.projection) expectProjected(*row.projection, where), seen.projection.add(*row.projection);
    seen.weights += row.weights;
    seen.exact_depths += row.exact_depths, seen.fine_orders += row.fine_orders;
    seen.worst = std::max(seen.worst, row.max_error);
    seen.of_bound = std::max(seen.of_bound, row.worst_of_bound);
    seen.float_worst = std::max(seen.float_worst, row.fp32.max_error);
}

/// Runs, prints what was met, and demands that the hard parts were.
std::vector<StabilityRow> expectStable(const StabilityOptions& options) {
    Progress progress;
    const auto rows = runStability(options, progress);
    Seen seen;
    for (const StabilityRow& row : rows) expectWithinBounds(row, seen);
    const ProjectionErrors& p = seen.projection;
    fmt::print(
        "{} rows, {} weights, {} exact depths, {} fine orders, worst error {:.1e}, {:.2f} of its bound; "
        "fp32 {:.1e}\n",
        rows.size(), seen.weights, seen.exact_depths, seen.fine_orders, seen.worst, seen.of_bound,
        seen.float_worst);
    EXPECT_GT(seen.float_worst, 0x1p-30) << "fp32 ran in double";
    fmt::print("{} vertices, {} made by planes, {} shared clipped edges, {} undecided, worst {:.1e} px\n",
               p.vertices, p.made, p.shared_edges, p.undecided, p.max_px);
    const MapReport& m = seen.maps;
    fmt::print(
        "{} maps, {} faces with a disk, {} points, {} of {} small faces of {:.1e} px2 shown otherwise, areas "
        "within {:.1e}\n",
        m.maps, m.faces_with_disk, m.points, m.small_wrong.size(), m.small_faces, m.small_area_px2,
        m.max_area_share);
    EXPECT_GT(m.faces_with_disk, 200u);
    EXPECT_GT(m.small_faces, 20u);
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
    options.scenes = 5;  // the fifth leaves an owner of weight 0 a rounding
    options.cases = {"sigma"};
    Progress progress;
    Seen seen;
    const auto rows = runStability(options, progress);
    for (const StabilityRow& row : rows) expectWithinBounds(row, seen);
    EXPECT_EQ(rows.size(), 5u);  // a decade each, 1e-2 to 1e2
    EXPECT_GT(seen.weights, 10u);
}

/// Scenes whose edges end on the support's box, some of them several in one point of its right side.
TEST(Stability, EdgesOfAnyLengthThroughTheSampleStayWithinTheirBound) {
    StabilityOptions options;
    options.filters = {makePrefilter("box", {}, {})};
    options.scenes = 4;
    options.cases = {"edge-through-sample"};
    Progress progress;
    Seen seen;
    for (const StabilityRow& row : runStability(options, progress)) expectWithinBounds(row, seen);
    EXPECT_GT(seen.maps.faces, 50u);
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

/// A triangle over a part of another, and their map.
struct Overlap {
    ScreenScene scene;
    exact::Region box{0, 0, 8, 8};
    VisibleMap map;

    Overlap() {
        witness::SceneBuilder builder;
        for (const double depth : {1.0, 2.0}) builder.addPlane(DepthPlane{0, 0, depth});
        builder.addOnPlane({glm::dvec2{1, 1}, {7, 1.5}, {2, 7}}, 0);
        builder.addOnPlane({glm::dvec2{2, 2}, {4, 2.25}, {2.5, 4}}, 1);
        scene = builder.scene();
        map = visibleMap(scene, {-1, -1, 9, 9});
    }
    StabilityRow row() const {
        StabilityRow row;
        row.case_name = "slivers", row.filter = "box", row.condition = 1;
        judgeMap(scene, exact::visibleFaces(scene, box), map, box, row);
        return row;
    }
};

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(Stability, ARightMapKeepsItsPromises) {
    const StabilityRow row = Overlap().row();
    EXPECT_TRUE(keepsPromises(row));
    EXPECT_EQ(row.map->faces_with_disk, 2u);
    EXPECT_TRUE(row.map_left_out.empty());
    EXPECT_TRUE(contains(stabilityHtml({row}, ""), "every one within its bound"));
}

TEST(Stability, AMapWithExchangedOwnersIsReported) {
    Overlap wrong;
    for (VisibleSegment& s : wrong.map.segments)
        for (Owner* owner : {&s.left, &s.right})
            if (*owner < 2) *owner = 1 - *owner;
    const StabilityRow row = wrong.row();
    EXPECT_FALSE(keepsPromises(row));
    const std::size_t errors = row.map->ownership_errors;
    EXPECT_GT(errors, 0u);
    EXPECT_TRUE(
        contains(stabilityJson({row}, ""),
                 fmt::format("\"ownership_errors\": {},\n    \"first_ownership_error\": \"at (", errors)));
    EXPECT_TRUE(contains(stabilityHtml({row}, ""), "1 rows break a promise"));
    EXPECT_TRUE(contains(stabilityHtml({row}, ""), fmt::format("{} ownership errors at", errors)));
    // The table of the worst shows it, though another row is nearer to its bound.
    StabilityRow other = Overlap().row();
    other.worst_of_bound = 0.9;
    EXPECT_TRUE(contains(stabilityLatex({other, row}), fmt::format(" & {} & 0 & 0.0e+00 & ", errors)));
}

TEST(Stability, AMovedEndIsReportedAsAnArea) {
    Overlap wrong;
    for (VisibleSegment& s : wrong.map.segments)
        for (FinePoint* p : {&s.a, &s.b})
            if (p->grid == glm::dvec2{4, 2.25}) p->grid.x += kDiskPx;
    const StabilityRow row = wrong.row();
    EXPECT_GT(row.map->max_area_share, kAreaShare);
    EXPECT_FALSE(keepsPromises(row));
}

TEST(Stability, MapsThatAreNotComparedSayWhy) {
    Overlap large;
    large.scene.triangles.resize(kMostTrianglesCompared + 1, large.scene.triangles[0]);
    const StabilityRow row = large.row();
    EXPECT_FALSE(row.map);
    EXPECT_TRUE(contains(stabilityJson({row}, ""), "\"map\": null"));
    for (const std::string& text :
         {stabilityJson({row}, ""), stabilityCsv({row}), stabilityLatex({row}), stabilityHtml({row}, "")})
        EXPECT_TRUE(contains(text, "too many triangles"));
    const std::string csv = stabilityCsv({row, Overlap().row()});
    const auto commas = [&](std::size_t from) {
        return std::count(csv.begin() + long(from), csv.begin() + long(csv.find('\n', from)), ',');
    };
    const std::size_t first = csv.find('\n') + 1, second = csv.find('\n', first) + 1;
    EXPECT_EQ(commas(first), commas(0));
    EXPECT_EQ(commas(second), commas(0));
}

TEST(Stability, ReportsHoldEveryRow) {
    StabilityRow row;
    row.case_name = "slivers", row.filter = "box", row.condition = 1e-3, row.max_error = 2e-16,
    row.bound = 1e-14, row.worst_of_bound = 0.02, row.fp32.max_error = 3e-8, row.fp32.worst_of_bound = 0.01;
    const std::vector<StabilityRow> rows{row, row};
    const std::string csv = stabilityCsv(rows);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
    EXPECT_NE(stabilityHtml(rows, "a < b").find("a &lt; b"), std::string::npos);
    EXPECT_NE(stabilityLatex(rows).find(
                  "slivers & box & 1e-03 & 2.0e-16 & 0.02 & 3.0e-08 & 0.01 & 0 & \\multicolumn{4}{l}{} & --"),
              std::string::npos);
    EXPECT_NE(stabilityJson(rows, "x").find("\"max_error\": 2e-16"), std::string::npos);
    EXPECT_NE(stabilityJson(rows, "x").find("\"max_error\": 3e-08"), std::string::npos);
    EXPECT_NE(csv.find("fp32.max_error"), std::string::npos);
}

}  // namespace
}  // namespace edgewise::judge
