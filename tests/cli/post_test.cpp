// `edgewise post` as scripts rely on it.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/read_picture.h"
#include "tests/cli/run_program.h"

namespace edgewise::test {
namespace {

void run(const TemporaryFolder& folder, const Arguments& arguments) {
    const ProgramRun done = runProgram(arguments, folder.path());
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
}

void renderNone(const TemporaryFolder& folder, const char* output, Arguments more = {}) {
    Arguments arguments{"render", "torus-20k", "-o",   output,     "--size",
                        "60x40",  "--method",  "none", "--device", "cpu"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    run(folder, arguments);
}

TEST(Post, OfThePictureOfNoneIsTheMethod) {
    const TemporaryFolder folder;
    renderNone(folder, "none.exr");
    for (const std::string method : {"smaa", "fxaa", "smaa:preset=ultra,edges=color,blend=gamma"}) {
        run(folder, {"post", "none.exr", "--method", method, "-o", "post.exr"});
        run(folder, {"render", "torus-20k", "-o", "method.exr", "--size", "60x40", "--method", method});
        const Picture post = readPicture(folder / "post.exr"), direct = readPicture(folder / "method.exr");
        ASSERT_EQ(post.values.size(), direct.values.size());
        // float32 of the file between them
        for (std::size_t i = 0; i < post.values.size(); ++i)
            ASSERT_NEAR(post.values[i], direct.values[i], 1e-6) << method;
        EXPECT_NE(post.values, readPicture(folder / "none.exr").values) << method;
    }
}

TEST(Post, PngInPngOut) {
    const TemporaryFolder folder;
    renderNone(folder, "none.png");
    run(folder, {"post", "none.png", "--method", "fxaa", "-o", "out.png", "--stats", "stats.json"});
    const Picture before = readPicture(folder / "none.png"), after = readPicture(folder / "out.png");
    EXPECT_EQ(after.spec.roi(), before.spec.roi());
    std::size_t same = 0;
    for (std::size_t i = 0; i < after.values.size(); ++i) same += after.values[i] == before.values[i];
    EXPECT_LT(same, after.values.size());          // edges changed
    EXPECT_GT(same, after.values.size() * 3 / 4);  // the rest came back code by code
    const auto stats = nlohmann::json::parse(readFile(folder / "stats.json"));
    EXPECT_TRUE(stats.at("stages").contains("fxaa"));
}

TEST(Post, KeepsBothWindows) {
    const TemporaryFolder folder;
    renderNone(folder, "none.exr", {"--crop", "17,5,43,31"});
    run(folder, {"post", "none.exr", "--method", "smaa", "-o", "out.exr"});
    const OIIO::ImageSpec spec = readPicture(folder / "out.exr").spec;
    EXPECT_EQ(spec.roi(), OIIO::ROI(17, 43, 5, 31, 0, 1, 0, 5));
    EXPECT_EQ(spec.roi_full(), OIIO::ROI(0, 60, 0, 40, 0, 1, 0, 5));
}

TEST(Post, SaysInTheMetadataHowItWasMade) {
    const TemporaryFolder folder;
    renderNone(folder, "none.exr");
    run(folder, {"post", "none.exr", "--method", "fxaa", "-o", "out.exr"});
    const OIIO::ImageSpec spec = readPicture(folder / "out.exr").spec;
    for (const char* key : {"edgewise:version", "edgewise:command", "edgewise:device", "edgewise:seed"})
        EXPECT_FALSE(spec.get_string_attribute(key).empty()) << key;
    EXPECT_EQ(spec.get_string_attribute("edgewise:seed"), "0");
}

TEST(Post, ExposureIsForPngAlone) {
    const TemporaryFolder folder;
    renderNone(folder, "none.exr");
    run(folder, {"post", "none.exr", "--method", "fxaa", "-o", "a.exr", "-o", "a.png"});
    run(folder, {"post", "none.exr", "--method", "fxaa", "-o", "b.exr", "-o", "b.png", "--exposure", "-1"});
    EXPECT_EQ(readPicture(folder / "a.exr").values, readPicture(folder / "b.exr").values);
    EXPECT_NE(readPicture(folder / "a.png").values, readPicture(folder / "b.png").values);
}

TEST(Post, ThreadsDoNotEnterThePixels) {
    const TemporaryFolder folder;
    renderNone(folder, "none.png");
    run(folder, {"post", "none.png", "--method", "smaa", "-o", "all.png", "-o", "all.exr"});
    run(folder, {"post", "none.png", "--method", "smaa", "-o", "one.exr", "--threads", "1"});
    EXPECT_EQ(readPicture(folder / "one.exr").values, readPicture(folder / "all.exr").values);
}

TEST(Post, WhatIsWrongIsOneLineAndStatus2) {
    const TemporaryFolder folder;
    renderNone(folder, "none.png");
    writeFile(folder / "text.png", "no picture");
    writeFile(folder / "cut.png", readFile(folder / "none.png").substr(0, 200));
    const std::vector<std::string> before = folder.names();
    const std::vector<std::pair<Arguments, const char*>> wrong{
        {{"missing.png", "--method", "smaa", "-o", "a.png"}, "missing.png"},
        {{"text.png", "--method", "smaa", "-o", "a.png"}, "text.png"},
        {{"cut.png", "--method", "smaa", "-o", "a.png"}, "cut.png"},
        {{"none.png", "--method", "smaa:preset=huge", "-o", "a.png"}, "preset"},
        {{"none.png", "--method", "fxaa:preset=16", "-o", "a.png"}, "preset"},
        {{"none.png", "--method", "fxaa+smaa", "-o", "a.png"}, "compose"},
        {{"none.png", "--method", "ssaa:2", "-o", "a.png"}, "ssaa:2"},
        {{"none.png", "--method", "smaa", "-o", "a.bmp"}, "a.bmp"},
        {{"none.png", "--method", "smaa", "-o", "no/a.png"}, "no"},
        {{"none.png", "--method", "smaa"}, "--output"},
        {{"none.png", "-o", "a.png"}, "--method"},
        {{"none.png", "--method", "smaa", "-o", "a.png", "--threads", "0"}, "--threads"},
    };
    for (const auto& [arguments, fragment] : wrong) {
        Arguments all{"post"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const ProgramRun done = runProgram(all, folder.path());
        EXPECT_EQ(done.status, 2) << fragment;
        ASSERT_EQ(lines(done.err).size(), 1u) << done.err;
        EXPECT_TRUE(done.err.starts_with("edgewise: error: ")) << done.err;
        EXPECT_NE(done.err.find(fragment), std::string::npos) << done.err;
        EXPECT_EQ(folder.names(), before);
    }
}

}  // namespace
}  // namespace edgewise::test
