// Scenes laid bare, and samples for an error, from rows made by hand: what they say can be worked out.
#include "paper_figures/shared_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "pipeline/error.h"

namespace edgewise::figures {
namespace {

compare::Row rowOfMethod(const std::string& method, double rmse) {
    compare::Row row = compare::rowOf(parseMethod(method), makePrefilter("box", 0.5, {}));
    row.size = {8, 8};
    row.seconds = {1.0}, row.setup_seconds = {0.0};
    row.error.emplace().rmse = rmse;
    return row;
}

TEST(SharedGeometry, BareScenesHaveNeitherGroundNorShadows) {
    const std::string bare = bareScene(R"({"lights": [{"direction": [0, -1, 0]}],
        "tree": {"type": "union", "children": [{"type": "plane", "normal": [0, 1, 0]},
                                               {"type": "sphere", "radius": 1}]}})",
                                       "test");
    const auto json = nlohmann::json::parse(bare);
    EXPECT_EQ(json["lights"][0]["shadows"], false);
    ASSERT_EQ(json["tree"]["children"].size(), 1u);
    EXPECT_EQ(json["tree"]["children"][0]["type"], "sphere");
    EXPECT_THROW(bareScene("{}", "test"), InputError);
    EXPECT_THROW(bareScene("{", "test"), InputError);
}

TEST(SharedGeometry, SamplesAreInterpolatedBetweenRowsOfTheField) {
    // Errors of 1 / samples.
    const std::vector<compare::Row> rows{rowOfMethod("ssaa:4", 1.0 / 16.0), rowOfMethod("none", 1.0),
                                         rowOfMethod("ssaa:2", 0.25), rowOfMethod("mesh+ssaa:8", 0.9),
                                         rowOfMethod("ctss", 0.1)};
    for (const double samples : {1.0, 2.0, 10.0, 16.0}) {
        const auto found = samplesFor(1.0 / samples, rows);
        ASSERT_TRUE(found) << samples;
        EXPECT_NEAR(*found, samples, 1e-9 * samples);
    }
    EXPECT_FALSE(samplesFor(2.0, rows));
    EXPECT_FALSE(samplesFor(0.01, rows));
}

TEST(SharedGeometry, PageAndTableHaveEveryRow) {
    SharedGeometry found;
    found.reference = "nsaa";
    compare::Comparison scene{"ball", "nsaa", "", "", {}, {}};
    scene.rows = {rowOfMethod("none", 0.5), rowOfMethod("ssaa:2", 0.25), rowOfMethod("ssaa:4", 0.0625),
                  rowOfMethod("ctss", 0.25), rowOfMethod("nsaa", 0.001)};
    scene.rows[4].antialiasing = compare::PictureDistance{0.0, 0.0, {}};
    scene.rows[4].mesh.emplace().triangles = 77;
    compare::MeshReference& reference = scene.mesh_reference.emplace();
    reference.levels.resize(2);
    reference.levels[1].left = compare::PictureDistance{3e-4, 1e-3, {}};
    found.scenes = {scene};
    const std::string csv = sharedGeometryCsv(found);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 6);
    EXPECT_NE(csv.find(",0,77,"), std::string::npos) << csv;
    const auto plots = sharedGeometryPlots(found);
    ASSERT_EQ(plots.size(), 1u);
    EXPECT_NE(sharedGeometryHtml(found, plots).find("3.00e-04"), std::string::npos);
    std::vector<FigureClaim> claims;
    addSharedClaims(found, claims);
    const auto of = [&](const std::string& words) {
        return *std::ranges::find_if(
            claims, [&](const FigureClaim& c) { return c.claim.find(words) != std::string::npos; });
    };
    EXPECT_EQ(of("same error as CTSS").ours, "ball 4.0");
    EXPECT_EQ(of("over no antialiasing").ours, "ball 1.00");
    EXPECT_EQ(of("reference without samples").ours, "ball 3.0e-04");
}

}  // namespace
}  // namespace edgewise::figures
