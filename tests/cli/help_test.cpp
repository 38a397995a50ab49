// --help says what the program does, and asking is no error.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/version.h"
#include "tests/cli/run_program.h"

namespace edgewise::test {
namespace {

TEST(Help, NamesEveryCommand) {
    const ProgramRun run = runProgram({"--help"});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.err, "");
    for (const char* command : {"render", "compare", "sweep", "merge", "polygonize", "weights", "metrics",
                                "post", "info", "methods", "filters", "scenes"})
        EXPECT_NE(run.out.find(std::string("\n  ") + command), std::string::npos) << command;
}

TEST(Help, NamesEveryKindOfScene) {
    const ProgramRun run = runProgram({"--help"});
    const std::size_t at = run.out.find("SCENE is");
    ASSERT_NE(at, std::string::npos);
    const std::string line = run.out.substr(at, run.out.find('\n', at) - at);
    for (const char* kind : {".gltf", ".glb", ".sdf.json", ".map.glsl"})
        EXPECT_NE(line.find(kind), std::string::npos) << kind;
}

TEST(Help, OfRenderNamesEveryFlag) {
    const ProgramRun run = runProgram({"render", "--help"});
    EXPECT_EQ(run.status, 0);
    for (const char* flag : {"-o",
                             "--size WxH",
                             "--crop X0,Y0,X1,Y1",
                             "--shift DX,DY",
                             "--scene NAME|INDEX",
                             "--camera NAME|INDEX",
                             "--eye X,Y,Z",
                             "--target X,Y,Z",
                             "--fovy DEG",
                             "--method M",
                             "--filter F",
                             "--radius R",
                             "--sigma S",
                             "--device cpu|vulkan|auto",
                             "--precision fp64|fp32",
                             "--shading closest|centroid|samples:N|hit",
                             "--background R,G,B",
                             "--exposure EV",
                             "--aov NAME",
                             "--threads N",
                             "--memory MIB",
                             "--stats FILE.json",
                             "--explain",
                             "--no-skip NAME",
                             "--dump-stages DIR",
                             "--seed N",
                             "--quiet"})
        EXPECT_NE(run.out.find(flag), std::string::npos) << flag;
}

TEST(Help, EveryCommandTakesQuiet) {
    for (const char* command : {"render", "compare", "sweep", "merge", "polygonize", "weights", "metrics",
                                "post", "info", "methods", "filters", "scenes", "figure", "figures"})
        EXPECT_NE(runProgram({command, "--help"}).out.find("--quiet"), std::string::npos) << command;
    EXPECT_EQ(runProgram({"info", "torus-20k", "--quiet"}).status, 0);
}

TEST(Help, VersionIsOneLine) {
    const ProgramRun run = runProgram({"--version"});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out, std::string("edgewise ") + version() + "\n");
}

TEST(Lists, HaveOneLineAnEntry) {
    for (const char* list : {"methods", "filters", "scenes"}) {
        const ProgramRun run = runProgram({list});
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_GT(lines(run.out).size(), 1u) << list;
    }
}

TEST(Info, IsJsonWithTheResolvedCamera) {
    const ProgramRun run = runProgram({"info", "torus-20k", "--json", "--size", "30x20"});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto info = nlohmann::json::parse(run.out);
    EXPECT_EQ(info.at("counts").at("triangles"), 20000);
    EXPECT_EQ(info.at("camera").at("size"), (std::vector<int>{30, 20}));
    EXPECT_EQ(info.at("camera").at("view").size(), 4u);
    EXPECT_TRUE(info.at("camera").contains("yfov"));
    EXPECT_TRUE(info.at("camera").contains("near"));
    EXPECT_TRUE(info.at("camera").contains("far"));
    EXPECT_EQ(info.at("lights").size(), 3u);
    EXPECT_TRUE(info.contains("cameras"));
    EXPECT_TRUE(info.contains("ignored"));
    EXPECT_FALSE(info.at("plan").empty());
}

TEST(Info, TakesACameraOfYourOwn) {
    const ProgramRun run =
        runProgram({"info", "torus-20k", "--json", "--eye", "0,0,5", "--target", "0,0,0", "--fovy", "90"});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto camera = nlohmann::json::parse(run.out).at("camera");
    EXPECT_EQ(camera.at("origin"), "command line");
    EXPECT_EQ(camera.at("view").at(2).at(3), -5.0);  // the target lies five ahead, down -z
}

}  // namespace
}  // namespace edgewise::test
