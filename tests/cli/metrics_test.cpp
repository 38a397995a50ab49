// `edgewise metrics`: numbers of two files, and one line for what cannot be compared.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "pipeline/write_image.h"
#include "tests/cli/run_program.h"

namespace edgewise::test {
namespace {

/// 16 x 12, colours (v, v/2, v/4).
ImageBuffer picture(double v) {
    ImageBuffer image({0, 0, 16, 12});
    for (glm::dvec4& pixel : image.rgba) pixel = {v, v / 2.0, v / 4.0, 1.0};
    return image;
}

void write(const TemporaryFolder& folder, const char* name, const ImageBuffer& image) {
    WriteOptions options;
    options.width = 16;
    options.height = 12;
    writeImage(folder / name, image, options);
}

TEST(MetricsCommand, JsonHasTheErrors) {
    const TemporaryFolder folder;
    write(folder, "a.exr", picture(0.5));
    ImageBuffer reference = picture(0.25);
    reference.edge[5] = 1.0f;
    write(folder, "b.exr", reference);
    const ProgramRun run = runProgram({"metrics", "a.exr", "b.exr", "--json"}, folder.path());
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const auto json = nlohmann::json::parse(run.out);
    const double rmse = std::sqrt((0.0625 + 0.015625 + 0.00390625) / 3.0);
    EXPECT_DOUBLE_EQ(json.at("rmse"), rmse);
    EXPECT_EQ(json.at("max"), 0.25);
    EXPECT_DOUBLE_EQ(json.at("bias"), 0.4375 / 3.0);
    EXPECT_DOUBLE_EQ(json.at("psnr"), -20.0 * std::log10(rmse));
    EXPECT_DOUBLE_EQ(json.at("edge_rmse"), rmse);
    EXPECT_DOUBLE_EQ(json.at("edge_psnr"), json.at("psnr"));
    EXPECT_GT(json.at("ssim"), 0.5);
    EXPECT_LT(json.at("ssim"), 1.0);
    EXPECT_GT(json.at("flip"), 0.0);
}

TEST(MetricsCommand, WordsHaveALineAMetric) {
    const TemporaryFolder folder;
    write(folder, "a.exr", picture(0.5));
    const ProgramRun run = runProgram({"metrics", "a.exr", "a.exr"}, folder.path());
    ASSERT_EQ(run.status, 0) << run.err;
    ASSERT_EQ(lines(run.out).size(), 8u);
    EXPECT_EQ(lines(run.out)[0], "rmse       0.0");
    EXPECT_EQ(lines(run.out)[3], "psnr       none");
}

// A picture of ours against its own PNG: half a step of 1/255 in sRGB at most, 1/255 * 0.5 * 1.055 * 2.4
// linear.
TEST(MetricsCommand, AnExrAgainstItsPngErrsByTheRounding) {
    const TemporaryFolder folder;
    write(folder, "a.exr", picture(0.7));
    write(folder, "a.png", picture(0.7));
    const ProgramRun run = runProgram({"metrics", "a.png", "a.exr", "--json"}, folder.path());
    ASSERT_EQ(run.status, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_GT(json.at("max"), 0.0);
    EXPECT_LT(json.at("max"), 0.5 / 255.0 * 2.4 / 1.055);
}

TEST(MetricsCommand, OtherPlacesAreAWarning) {
    const TemporaryFolder folder;
    ImageBuffer crop = picture(0.5);
    crop.box = {2, 3, 18, 15};
    write(folder, "a.exr", picture(0.5));
    write(folder, "b.exr", crop);
    const ProgramRun run = runProgram({"metrics", "a.exr", "b.exr"}, folder.path());
    EXPECT_EQ(run.status, 0);
    ASSERT_EQ(lines(run.err).size(), 1u);
    EXPECT_NE(run.err.find("edgewise: warning: the data windows begin at 0,0 and 2,3"), std::string::npos);
}

/// OpenImageIO writes what write_image refuses to.
TEST(MetricsCommand, ANotFiniteValueIsRefusedNamingThePixel) {
    const TemporaryFolder folder;
    write(folder, "a.exr", picture(0.5));
    std::vector<float> values(16 * 12 * 3, 0.5f);
    values[(7 * 16 + 9) * 3 + 2] = std::numeric_limits<float>::infinity();
    const auto output = OIIO::ImageOutput::create("inf.exr");
    ASSERT_TRUE(
        output->open((folder / "inf.exr").string(), OIIO::ImageSpec(16, 12, 3, OIIO::TypeDesc::FLOAT)));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    ASSERT_TRUE(output->close());
    const ProgramRun run = runProgram({"metrics", "inf.exr", "a.exr"}, folder.path());
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err, "edgewise: error: inf.exr: pixel 9,7 is inf, not a finite number\n");
}

TEST(MetricsCommand, WrongInputIsOneLineAndStatusTwo) {
    const TemporaryFolder folder;
    write(folder, "a.exr", picture(0.5));
    ImageBuffer small({0, 0, 12, 16});
    write(folder, "small.exr", small);
    writeFile(folder / "text.exr", "no picture");
    const struct {
        Arguments arguments;
        const char* fragment;
    } cases[] = {{{"metrics"}, "IMAGE"},
                 {{"metrics", "a.exr"}, "REFERENCE"},
                 {{"metrics", "a.exr", "none.exr"}, "none.exr: no such file"},
                 {{"metrics", "text.exr", "a.exr"}, "text.exr: is neither EXR nor PNG"},
                 {{"metrics", "small.exr", "a.exr"}, "small.exr: is 12x16 pixels, a.exr is 16x12"},
                 {{"metrics", ".", "a.exr"}, ".: is not a regular file"}};
    for (const auto& one : cases) {
        const ProgramRun run = runProgram(one.arguments, folder.path());
        EXPECT_EQ(run.status, 2) << one.fragment;
        EXPECT_EQ(run.out, "");
        ASSERT_EQ(lines(run.err).size(), 1u) << run.err;
        EXPECT_NE(run.err.find(one.fragment), std::string::npos) << run.err;
    }
}

}  // namespace
}  // namespace edgewise::test
