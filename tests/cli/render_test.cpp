// `edgewise render` as scripts rely on it: the same file every time, both EXR windows, crops, statistics,
// Ctrl-C.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipeline/version.h"
#include "tests/cli/read_picture.h"
#include "tests/cli/run_program.h"

namespace edgewise::test {
namespace {

/// Renders `torus-20k` at 60x40 with more arguments behind; fails the test when the program does.
ProgramRun render(const TemporaryFolder& folder, const std::string& output, Arguments more = {}) {
    Arguments arguments{"render", "torus-20k", "-o", output, "--size", "60x40", "--method", "ssaa:2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ProgramRun run = runProgram(arguments, folder.path());
    EXPECT_EQ(run.status, 0) << run.err;
    return run;
}

TEST(Render, TheSameCommandGivesTheSameFile) {
    for (const std::string name : {"a.exr", "a.png"}) {
        const TemporaryFolder first, second;
        render(first, name);
        render(second, name);
        EXPECT_EQ(readFile(first / name), readFile(second / name)) << name;
        EXPECT_EQ(first.names(), std::vector<std::string>{name});
    }
}

TEST(Render, ThreadsDoNotEnterThePixels) {
    const TemporaryFolder folder;
    render(folder, "one.exr", {"--threads", "1"});
    render(folder, "all.exr");
    EXPECT_EQ(readPicture(folder / "one.exr").values, readPicture(folder / "all.exr").values);
}

TEST(Render, ACropIsThatPartOfTheWholeBitForBit) {
    const TemporaryFolder folder;
    render(folder, "whole.exr");
    render(folder, "crop.exr", {"--crop", "17,5,43,31"});
    const Picture whole = readPicture(folder / "whole.exr");
    const Picture crop = readPicture(folder / "crop.exr");
    EXPECT_EQ(whole.spec.roi(), OIIO::ROI(0, 60, 0, 40, 0, 1, 0, 5));
    EXPECT_EQ(crop.spec.roi(), OIIO::ROI(17, 43, 5, 31, 0, 1, 0, 5));
    EXPECT_EQ(crop.spec.roi_full(), OIIO::ROI(0, 60, 0, 40, 0, 1, 0, 5));
    int lit = 0;
    for (int y = 5; y < 31; ++y) {
        for (int x = 17; x < 43; ++x) {
            for (int c = 0; c < 5; ++c)
                EXPECT_EQ(crop.at(x, y)[c], whole.at(x, y)[c]) << x << ' ' << y << ' ' << c;
            lit += crop.at(x, y)[3] > 0.0f;
        }
    }
    EXPECT_GT(lit, 26 * 26 / 4);  // the crop did show the torus
}

TEST(Render, MetadataSaysWhatWasDone) {
    const TemporaryFolder folder;
    render(folder, "a.exr", {"--seed", "11"});
    const OIIO::ImageSpec spec = readPicture(folder / "a.exr").spec;
    EXPECT_EQ(spec.get_string_attribute("edgewise:version"), version());
    EXPECT_EQ(spec.get_string_attribute("edgewise:command"),
              "edgewise render torus-20k -o a.exr --size 60x40 --method ssaa:2 --seed 11");
    EXPECT_EQ(spec.get_string_attribute("edgewise:device"), "cpu");
    EXPECT_EQ(spec.get_string_attribute("edgewise:seed"), "11");
}

TEST(Render, SeveralOutputsAreOneImage) {
    const TemporaryFolder folder;
    render(folder, "a.exr", {"-o", "a.png", "--exposure", "-1"});
    const Picture exr = readPicture(folder / "a.exr");
    const Picture png = readPicture(folder / "a.png");
    EXPECT_EQ(png.spec.nchannels, 3);
    EXPECT_EQ(png.spec.width, exr.spec.width);
    EXPECT_EQ(png.spec.height, exr.spec.height);
}

TEST(Render, AnOutputNamedTwiceIsWritten) {
    const TemporaryFolder folder;
    render(folder, "a.exr", {"-o", "./a.exr"});
    EXPECT_EQ(readPicture(folder / "a.exr").spec.width, 60);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.exr"});
}

TEST(Render, BackgroundFillsWhatNothingCovers) {
    const TemporaryFolder folder;
    render(folder, "a.exr", {"--background", "0.25,0.5,2"});
    const Picture picture = readPicture(folder / "a.exr");
    const float* corner = picture.at(0, 0);
    EXPECT_EQ(corner[0], 0.25f);
    EXPECT_EQ(corner[1], 0.5f);
    EXPECT_EQ(corner[2], 2.0f);
    EXPECT_EQ(corner[3], 0.0f);
    EXPECT_EQ(corner[4], 0.0f);
}

TEST(Render, EveryMethodTakesEveryShading) {
    for (const std::string method : {"nsaa", "ssaa:2", "none"})
        for (const std::string shading : {"closest", "centroid", "samples:3", "hit"}) {
            const TemporaryFolder folder;
            const ProgramRun run = runProgram({"render", "torus-20k", "-o", "a.exr", "--size", "16x16",
                                               "--method", method, "--shading", shading, "--stats", "a.json"},
                                              folder.path());
            EXPECT_EQ(run.status, 0) << run.err;
            const auto notes = nlohmann::json::parse(readFile(folder / "a.json")).at("notes");
            EXPECT_EQ(notes.size(), method == "nsaa" && shading == "hit" ? 1u : 0u) << method << shading;
        }
}

TEST(Render, StatisticsAreJson) {
    const TemporaryFolder folder;
    render(folder, "a.exr", {"--stats", "a.json"});
    const auto stats = nlohmann::json::parse(readFile(folder / "a.json"));
    EXPECT_TRUE(stats.at("stages").is_object());
    EXPECT_FALSE(stats.at("stages").empty());
    EXPECT_TRUE(stats.at("counts").is_object());
    EXPECT_GT(stats.at("peak_mib").get<double>(), 0.0);
    for (const auto& entry : stats.at("plan")) {
        EXPECT_TRUE(entry.at("stage").is_string());
        EXPECT_TRUE(entry.at("runs").is_boolean());
        EXPECT_TRUE(entry.at("why").is_string());
    }
}

TEST(Render, NothingIsDrawnWhereThereIsNoTerminal) {
    const TemporaryFolder folder;
    const ProgramRun run = render(folder, "a.exr");
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err, "");
}

TEST(Render, AovsAreChannelsOfTheExrAlone) {
    const TemporaryFolder folder;
    render(folder, "plain.exr");
    render(folder, "a.exr",
           {"-o", "a.png", "--aov", "cryptomatte", "--aov", "depth", "--aov", "depth", "--aov", "normal",
            "--aov", "index", "--aov", "owners"});
    const Picture plain = readPicture(folder / "plain.exr"), picture = readPicture(folder / "a.exr");
    EXPECT_EQ(readPicture(folder / "a.png").spec.nchannels, 3);
    EXPECT_EQ(picture.spec.nchannels, 5 + 1 + 3 + 1 + 1 + 24);
    for (const char* name :
         {"Z", "N.X", "N.Y", "N.Z", "owners", "CryptoObject00.red", "CryptoMaterial02.alpha"})
        EXPECT_EQ(picture.spec.channelformat(picture.spec.channelindex(name)), OIIO::TypeDesc::FLOAT) << name;
    EXPECT_EQ(picture.spec.channelformat(picture.spec.channelindex("index")), OIIO::TypeDesc::UINT32);
    EXPECT_EQ(picture.spec.get_string_attribute("cryptomatte/3ae39a5/name"), "CryptoObject");
    EXPECT_EQ(picture.at(0, 0)[picture.spec.channelindex("Z")], 1e10f);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 60; ++x)
            for (const char* name : {"R", "G", "B", "A", "edge"})
                ASSERT_EQ(picture.at(x, y)[picture.spec.channelindex(name)],
                          plain.at(x, y)[plain.spec.channelindex(name)]);
}

// A picture of 24 MB of channels within 16 MiB: made in strips, which nothing in it shows.
TEST(Render, APictureLargerThanTheMemoryHasTheSamePixels) {
    const TemporaryFolder folder;
    const auto run = [&](const std::string& name, const Arguments& more) {
        Arguments arguments{"render", "torus-20k",   "--size", "400x400",     "--crop", "3,5,393,395",
                            "--aov",  "cryptomatte", "-o",     name + ".exr", "-o",     name + ".png"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramRun made = runProgram(arguments, folder.path());
        EXPECT_EQ(made.status, 0) << made.err;
    };
    run("whole", {});
    run("strips", {"--memory", "16", "--stats", "small.json"});
    EXPECT_EQ(readPicture(folder / "whole.exr").values, readPicture(folder / "strips.exr").values);
    EXPECT_EQ(readPicture(folder / "whole.png").values, readPicture(folder / "strips.png").values);
    const auto stats = nlohmann::json::parse(readFile(folder / "small.json"));
    EXPECT_EQ(stats.at("counts").at("triangles"), 20000);
    EXPECT_EQ(folder.names().size(), 5u);
}

TEST(Render, ASceneTooLargeForTheMemoryFailsInOneLine) {
    const TemporaryFolder folder;
    const ProgramRun run =
        runProgram({"render", "torus-200k", "-o", "a.exr", "--memory", "2"}, folder.path());
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(lines(run.err).size(), 1u) << run.err;
    EXPECT_NE(run.err.find("edgewise: error: --memory: "), std::string::npos) << run.err;
    EXPECT_TRUE(folder.names().empty());
}

// From the start of the program to its end, through every stage; how soon is no question for a test.
TEST(Render, CtrlCLeavesNothingWheneverItComes) {
    int interrupted = 0, finished = 0;
    for (int after_ms = 50; finished < 2 && after_ms < 20000; after_ms *= 2) {
        const TemporaryFolder folder;
        const ProgramRun run = runProgram({"render", "torus-20k", "-o", "a.exr", "-o", "a.png", "--size",
                                           "900x900", "--aov", "cryptomatte"},
                                          folder.path(), after_ms);
        const std::size_t files = folder.names().size();
        finished += run.status == 0, interrupted += run.status == 130;
        // Before the program catches it, the signal itself ends the process.
        EXPECT_TRUE(run.status == 0 || run.status == 130 || run.status == 128 + 2) << run.status << run.err;
        EXPECT_TRUE(run.status == 0 ? files == 2 : files <= 1) << run.status;
        EXPECT_EQ(run.err, "");
        for (const std::string& name : folder.names()) EXPECT_EQ(name.find(".tmp"), std::string::npos);
    }
    EXPECT_GT(interrupted, 0);
}

TEST(Render, CtrlCEndsWith130AndLeavesNothing) {
    const TemporaryFolder folder;
    // Far more work than the interrupt waits for, on any machine: 64 Mpx of 256 samples each.
    const ProgramRun run = runProgram({"render", "torus-20k", "-o", "a.exr", "--size", "8192x8192",
                                       "--method", "ssaa:16", "--stats", "a.json"},
                                      folder.path(), 500);
    EXPECT_EQ(run.status, 130) << run.err;
    EXPECT_TRUE(folder.names().empty());
}

TEST(Render, FoldersOfStagesAreNeverLeftEmpty) {
    const TemporaryFolder folder;
    render(folder, "a.exr", {"--dump-stages", "stages"});
    for (const char* name : {"screen.csv", "samples.csv", "samples.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / ("stages/" + std::string(name)))) << name;
    if (runProgram({"methods"}).out.find("\nexact:") == std::string::npos)
        GTEST_SKIP() << "built without the oracle";
    const ProgramRun exact =
        runProgram({"render", "torus-20k", "-o", "b.exr", "--size", "60x40", "--crop", "20,20,22,22",
                    "--filter", "box", "--method", "exact", "--dump-stages", "none"},
                   folder.path());
    EXPECT_EQ(exact.status, 0) << exact.err;
    EXPECT_NE(exact.err.find("'exact' has no stages to dump"), std::string::npos) << exact.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "none"));
}

}  // namespace
}  // namespace edgewise::test
