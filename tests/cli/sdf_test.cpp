// SDF scenes as users and scripts meet them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/read_picture.h"
#include "tests/cli/run_program.h"

namespace edgewise::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A white ball of a little less than half the picture's height, on a grey sky; the file's own camera and
/// light.
constexpr const char* kBall = R"({
 "background": [0.25, 0.25, 0.25],
 "cameras": [{"eye": [0, 0, 10], "target": [0, 0, 0], "type": "orthographic", "ymag": 2}],
 "materials": {"white": {"color": [1, 1, 1], "shading": "unlit"}},
 "tree": {"type": "sphere", "radius": 0.95, "material": "white"}
})";

ProgramRun inFolder(const TemporaryFolder& folder, const Arguments& arguments) {
    writeFile(folder / "ball.sdf.json", kBall);
    return runProgram(arguments, folder.path());
}

TEST(SdfCommand, PolygonizesIntoAGltfWithItsRecord) {
    const TemporaryFolder folder;
    const ProgramRun run = inFolder(
        folder, {"polygonize", "ball.sdf.json", "-o", "ball.glb", "--resolution", "16", "--stats", "s.json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json record = json::parse(run.out);
    EXPECT_EQ(record, json::parse(readFile(folder / "s.json")));
    EXPECT_EQ(record["euler"], 2);
    EXPECT_TRUE(record["closed"]);
    const ProgramRun info = runProgram({"info", "ball.glb", "--json"}, folder.path());
    EXPECT_EQ(info.status, 0) << info.err;
    const Arguments wrong[] = {{"--mesher", "best"},
                               {"--resolution", "0"},
                               {"--box", "1,2,3"},
                               {"--box", "0,0,0,0,1,1"},
                               {"--box", "0,0,0,2,2,2"}};
    for (const Arguments& more : wrong) {
        Arguments arguments{"polygonize", "ball.sdf.json", "-o", "wrong.glb"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramRun refused = runProgram(arguments, folder.path());
        EXPECT_EQ(refused.status, 2) << more.back();
        EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
        EXPECT_FALSE(fs::exists(folder / "wrong.glb"));
    }
}

TEST(SdfCommand, PolygonizesWithinAnErrorOrSaysThatItIsNotMet) {
    const TemporaryFolder folder;
    std::size_t before = 0;
    for (const std::string error : {"0.02", "0.002"}) {
        const ProgramRun run = inFolder(folder, {"polygonize", "ball.sdf.json", "-o", "ball.glb",
                                                 "--resolution", "16", "--max-error", error});
        if (run.status == 1 && run.err.find("no CGAL") != std::string::npos) GTEST_SKIP() << run.err;
        ASSERT_EQ(run.status, 0) << run.err;
        const json record = json::parse(run.out);
        EXPECT_LE(record["distance"]["mesh_to_surface"], std::stod(error));
        EXPECT_LE(record["distance"]["surface_to_mesh"], std::stod(error));
        EXPECT_TRUE(record["closed"]);
        EXPECT_EQ(record["self_intersections"], 0);
        EXPECT_GT(record["triangles"], before);
        before = record["triangles"];
    }
    // Rounding alone is more than that, however small cells are: positions about 1.
    const ProgramRun refused =
        inFolder(folder, {"polygonize", "ball.sdf.json", "-o", "wrong.glb", "--mesher", "marching-cubes",
                          "--resolution", "8", "--max-error", "1e-18"});
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("--max-error: 1e-18 is not met"), std::string::npos) << refused.err;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_FALSE(fs::exists(folder / "wrong.glb"));
    for (const std::string wrong : {"0", "-1", "nan", "small"}) {
        const ProgramRun run =
            inFolder(folder, {"polygonize", "ball.sdf.json", "-o", "wrong.glb", "--max-error", wrong});
        EXPECT_EQ(run.status, 2) << wrong;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

TEST(SdfCommand, CapsSolidsAtTheBox) {
    const TemporaryFolder folder;
    writeFile(folder / "ground.sdf.json", R"({"cameras": [{"eye": [0, 3, 10], "target": [0, 0, 0]}],
 "tree": {"type": "union", "children": [{"type": "plane", "normal": [0, 1, 0], "offset": 0},
                                        {"type": "sphere", "radius": 0.5}]}})");
    const Arguments command{"polygonize", "ground.sdf.json", "-o", "ground.glb", "--resolution", "24"};
    const auto with = [&](const Arguments& more) {
        Arguments arguments = command;
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runProgram(arguments, folder.path());
    };
    const ProgramRun run = with({"--cap", "--box", "-1,-0.6,-1,1,0.9,1.2"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json record = json::parse(run.out);
    EXPECT_TRUE(record["closed"]);
    EXPECT_EQ(record["euler"], 2);
    // A slab and half a ball, whose chords lie within it: by a cell's sagitta all over it.
    const double cell = record["cell"], slab = 2.0 * 0.6 * 2.2,
                 half_ball = 2.0 / 3.0 * glm::pi<double>() * 0.125;
    EXPECT_LE(record["volume"], slab + half_ball + 1e-12);
    EXPECT_GE(record["volume"],
              slab + half_ball - 2.0 * glm::pi<double>() * 0.25 * cell * cell / (8.0 * 0.5) * 2.0);
    for (const Arguments& more :
         {Arguments{}, Arguments{"--cap"}, Arguments{"--box", "-1,-0.6,-1,1,0.9,1.2"}}) {
        const ProgramRun refused = with(more);
        EXPECT_EQ(refused.status, 2);
        EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    }
}

TEST(SdfCommand, RendersWithEveryMethodAndAllChannels) {
    for (const std::string method : {"none", "sphere:relax=balint,discontinuity=3", "ssaa:2", "smaa", "fxaa",
                                     "lottes:grain=0", "path:4"}) {
        const TemporaryFolder folder;
        const ProgramRun run =
            inFolder(folder, {"render", "ball.sdf.json", "-o", "a.exr", "--size", "32x32", "--filter", "box",
                              "--method", method, "--aov", "depth", "--aov", "index", "--device", "cpu"});
        ASSERT_EQ(run.status, 0) << method << run.err;
        const Picture picture = readPicture(folder / "a.exr");
        const int edge = picture.spec.channelindex("edge"), depth = picture.spec.channelindex("Z");
        ASSERT_GE(edge, 0) << method;
        ASSERT_GE(depth, 0) << method;
        EXPECT_NEAR(picture.at(16, 16)[0], 1.0, 1e-6) << method;
        EXPECT_NEAR(picture.at(1, 1)[0], 0.25, 1e-6) << method;
        EXPECT_EQ(picture.at(16, 16)[edge], 0.0f) << method;
        EXPECT_EQ(picture.at(1, 1)[edge], 0.0f) << method;
        EXPECT_EQ(picture.at(16, 8)[edge], 1.0f) << method << ": the outline, at 8.4";
        EXPECT_NEAR(picture.at(16, 16)[depth], 9.05, 0.02) << method;
    }
}

TEST(SdfCommand, TriangleMethodsPolygonizeAndSaySo) {
    for (const std::string method : {"nsaa", "msaa:4", "csaa:32", "rt:4", "mesh:error=0.1+ssaa:4"}) {
        const TemporaryFolder folder;
        const ProgramRun run = inFolder(
            folder, {"render", "ball.sdf.json", "-o", "a.exr", "--stats", "s.json", "--size", "32x32",
                     "--filter", "box", "--method", method, "--memory", "1", "--device", "cpu"});
        if (run.err.find("CGAL") != std::string::npos) GTEST_SKIP() << run.err;
        if (run.err.find("no method is called") != std::string::npos) continue;  // a build without Embree
        ASSERT_EQ(run.status, 0) << method << run.err;
        EXPECT_NE(run.err.find("polygonized by 'dual'"), std::string::npos) << run.err;
        const json stats = json::parse(readFile(folder / "s.json"));
        EXPECT_LE(stats["mesh"]["error_px"], 0.25) << method;
        EXPECT_GT(stats["mesh"]["triangles"], 100) << method;
        EXPECT_EQ(stats["counts"]["triangles"], stats["mesh"]["triangles"]) << method;
        EXPECT_GE(stats["setup_seconds"], stats["mesh"]["seconds"]) << method;
        EXPECT_DOUBLE_EQ(stats["mesh"]["pixel"], 4.0 / 32.0);  // orthographic
        const Picture picture = readPicture(folder / "a.exr");
        EXPECT_NEAR(picture.at(16, 16)[0], 1.0, 1e-6) << method;
        EXPECT_NEAR(picture.at(1, 1)[0], 0.25, 1e-6) << method;
    }
}

TEST(SdfCommand, ComparesBothFamiliesOnOneGeometry) {
    const TemporaryFolder folder;
    const ProgramRun run =
        inFolder(folder, {"compare",     "ball.sdf.json", "-o",       "out",  "--size",   "32x32",
                          "--reference", "nsaa",          "--runs",   "1",    "--filter", "box",
                          "--device",    "cpu",           "--method", "nsaa", "--method", "ssaa:4",
                          "--method",    "mesh+ssaa:4",   "--method", "none"});
    if (run.err.find("CGAL") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("the reference's own"), std::string::npos) << run.out;
    EXPECT_NE(readFile(folder / "out/report.html").find("Shared geometry"), std::string::npos);
    const json results = json::parse(readFile(folder / "out/results.json"));
    const json& reference = results.at("mesh_reference");
    ASSERT_GE(reference.at("levels").size(), 2u);
    const json& last = reference.at("levels").back().at("own_error");
    EXPECT_LT(last.at("rmse"), 0.5 * reference.at("levels")[1].at("own_error").at("rmse").get<double>());
    EXPECT_EQ(reference.at("reached"), last.at("rmse") <= reference.at("stated"));
    double before = 1.0;
    for (const json& level : reference.at("levels")) {
        EXPECT_LT(level.at("mesh").at("error_px"), before);
        before = level.at("mesh").at("error_px");
    }
    EXPECT_LE(reference.at("silhouette_px").at("field_to_mesh"), 0.25);
    EXPECT_LE(reference.at("silhouette_px").at("mesh_to_field"), 0.25);
    const auto row = [&](const std::string& method) {
        for (const json& r : results.at("rows"))
            if (r.at("method") == method) return r;
        return json();
    };
    for (const json& r : results.at("rows")) EXPECT_FALSE(r.at("reference_error").is_null());
    // Exact antialiasing of its own mesh: what nsaa errs by is the mesh's.
    EXPECT_EQ(row("nsaa").at("antialiasing").at("rmse"), 0.0);
    EXPECT_GT(row("nsaa").at("error").at("rmse"), 0.0);
    EXPECT_GT(row("mesh+ssaa:4").at("antialiasing").at("rmse"), 0.0);
    EXPECT_TRUE(row("ssaa:4").at("antialiasing").is_null());
    EXPECT_TRUE(row("ssaa:4").at("mesh").is_null());
    EXPECT_LT(row("ssaa:4").at("error").at("rmse"), row("none").at("error").at("rmse"));
}

TEST(SdfCommand, RefusesChannelsThatCountTriangles) {
    for (const char* method : {"none", "lottes", "path:1"}) {
        const TemporaryFolder folder;
        const ProgramRun run = inFolder(folder, {"render", "ball.sdf.json", "-o", "a.exr", "--size", "16x16",
                                                 "--method", method, "--aov", "cryptomatte"});
        EXPECT_EQ(run.status, 2) << method;
        ASSERT_EQ(lines(run.err).size(), 1u) << run.err;
        EXPECT_NE(run.err.find("--aov cryptomatte"), std::string::npos) << run.err;
    }
}

TEST(SdfCommand, DumpsStagesAndExplains) {
    const TemporaryFolder folder;
    const ProgramRun run =
        inFolder(folder, {"render", "ball.sdf.json", "-o", "a.exr", "--size", "24x16", "--method", "sphere",
                          "--dump-stages", "stages", "--explain", "--device", "cpu"});
    ASSERT_EQ(run.status, 0) << run.err;
    for (const char* name : {"evaluations.png", "iterations.png", "residual.png"}) {
        const Picture picture = readPicture(folder / ("stages/" + std::string(name)));
        EXPECT_EQ(picture.spec.width, 24) << name;
        EXPECT_EQ(picture.spec.height, 16) << name;
    }
    EXPECT_EQ(lines(readFile(folder / "stages/field.csv")).size(), 1u + 24 * 16);
    EXPECT_NE((run.out + run.err).find("prune"), std::string::npos);
}

TEST(SdfCommand, InfoTellsThePlanAndWhatIsIgnored) {
    const TemporaryFolder folder;
    const ProgramRun run = inFolder(folder, {"info", "ball.sdf.json", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json info = json::parse(run.out);
    EXPECT_EQ(info.at("ignored"), json::array());
    ASSERT_EQ(info.at("plan").size(), 4u);
    for (const json& entry : info["plan"]) EXPECT_FALSE(entry.at("why").get<std::string>().empty());
    EXPECT_EQ(info["plan"][0], (json{{"stage", "prepass"},
                                     {"runs", true},
                                     {"why", "cones find how far the rays of a tile are free"}}));
}

TEST(SdfCommand, MethodsListTheirParametersAndRanges) {
    const ProgramRun run = runProgram({"methods"});
    for (const char* words :
         {"relax=none|keinert|balint|auto", "omega=1..2", "discontinuity=0..64", "candidate=last|screen",
          "prepass=on|off", "level-set=on|off", "lottes:", "grain=0..1", "path:1..65536"})
        EXPECT_NE(run.out.find(words), std::string::npos) << words;
}

TEST(SdfCommand, ComparesAgainstSsaa16) {
    const TemporaryFolder folder;
    Arguments arguments{"compare", "ball.sdf.json", "-o", "out",      "--size",
                        "24x16",   "--runs",        "1",  "--device", "cpu"};
    for (const char* method : {"none", "sphere", "ssaa:2", "smaa", "fxaa", "lottes", "path:4"})
        arguments.insert(arguments.end(), {"--method", method});
    const ProgramRun run = inFolder(folder, arguments);
    ASSERT_EQ(run.status, 0) << run.err;
    const json results = json::parse(readFile(folder / "out/results.json"));
    EXPECT_EQ(results.at("reference"), "ssaa:16");
    ASSERT_EQ(results.at("rows").size(), 7u);
    double one = 0.0, four = 0.0;
    for (const json& row : results.at("rows")) {
        EXPECT_EQ(row.at("status"), "ok") << row;
        EXPECT_TRUE(row.at("error").at("edge_rmse").is_number()) << row;
        EXPECT_GE(row.at("error").at("edge_rmse"), row.at("error").at("rmse")) << "errors lie on edges";
        if (row.at("method") == "none") one = row.at("error").at("rmse");
        if (row.at("method") == "ssaa:2") four = row.at("error").at("rmse");
    }
    EXPECT_LT(four, 0.5 * one);
    EXPECT_GT(four, 0.0);
    EXPECT_TRUE(fs::exists(folder / "out/report.html"));
}

/// By kinds of edges, in every file; rows that are kept know theirs.
TEST(SdfCommand, ComparesByKindsOfEdges) {
    const TemporaryFolder folder;
    const Arguments arguments{"compare",  "ball.sdf.json", "-o",   "out",         "--size",
                              "24x16",    "--runs",        "1",    "--reference", "ssaa:4",
                              "--resume", "--method",      "none", "--method",    "ssaa:2"};
    json first;
    for (int run = 0; run < 2; ++run) {
        const ProgramRun done = inFolder(folder, arguments);
        ASSERT_EQ(done.status, 0) << done.err;
        EXPECT_NE(done.out.find("ssaa:4 itself, by ssaa:6"), std::string::npos) << done.out;
        const json results = json::parse(readFile(folder / "out/results.json"));
        if (run == 0) first = results;
        EXPECT_EQ(results.at("reference_error").at("judge"), "ssaa:6");
        for (std::size_t i = 0; i < 2; ++i) {
            const json& kinds = results.at("rows").at(i).at("edge_kinds");
            std::uint64_t pixels = 0;
            for (const auto& [name, kind] : kinds.items())
                if (name != "edges") pixels += kind.at("pixels").get<std::uint64_t>();
            EXPECT_EQ(pixels, 24u * 16u);
            EXPECT_GT(kinds.at("contour").at("pixels"), 0);
            EXPECT_NEAR(kinds.at("contour").at("rmse").get<double>(),
                        first.at("rows").at(i).at("edge_kinds").at("contour").at("rmse").get<double>(),
                        1e-15);
        }
        EXPECT_LT(results.at("reference_error").at("kinds").at("edges").at("rmse"),
                  results.at("rows").at(1).at("edge_kinds").at("edges").at("rmse"));
    }
    const auto csv = lines(readFile(folder / "out/results.csv"));
    EXPECT_NE(csv.front().find("contour_pixels,contour_rmse,contour_psnr"), std::string::npos);
    for (const std::string& line : csv)
        EXPECT_EQ(std::ranges::count(line, ','), std::ranges::count(csv.front(), ','));
    const std::string page = readFile(folder / "out/report.html");
    EXPECT_NE(page.find("By kinds of edges"), std::string::npos);
    EXPECT_NE(page.find("kinds of edges\",\"picture\":\"data:image/png"), std::string::npos);
    EXPECT_EQ(readPicture(folder / "out/edge-kinds.png").spec.width, 24);
}

TEST(SdfCommand, StudiesToo) {
    const TemporaryFolder folder;
    fs::copy_file(fs::path(EDGEWISE_TEST_DATA) / "degenerate/piercing.gltf", folder / "triangles.gltf");
    writeFile(folder / "study.toml",
              "scenes = ['ball.sdf.json', 'triangles.gltf']\nmethods = ['none', 'ssaa:2']\n"
              "filters = ['box']\nsizes = ['16x16']\nruns = 1\ndevice = 'cpu'\n");
    const ProgramRun run = inFolder(folder, {"sweep", "study.toml", "-o", "out"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json results = json::parse(readFile(folder / "out/results.json"));
    ASSERT_EQ(results.at("rows").size(), 4u);
    for (const json& row : results.at("rows")) {
        EXPECT_EQ(row.at("status"), "ok");
        EXPECT_EQ(row.at("reference"), row.at("scene") == "ball.sdf.json" ? "ssaa:16" : "nsaa,device=cpu");
    }
}

}  // namespace
}  // namespace edgewise::test
