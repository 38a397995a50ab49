// What write_image wrote, and what other programs write, comes back.
#include "pipeline/read_image.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "pipeline/decode_image.h"
#include "pipeline/error.h"
#include "pipeline/srgb.h"
#include "pipeline/write_image.h"

namespace edgewise {
namespace {

/// A folder of its own for a test's files.
class ReadImage : public testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "edgewise_read_XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path path(const std::string& name) const { return folder_ / name; }

    /// Writes `values` with OpenImageIO, as another program would.
    template <class T>
    std::filesystem::path writeOther(const std::string& name, const OIIO::ImageSpec& spec,
                                     const std::vector<T>& values) const {
        const auto output = OIIO::ImageOutput::create(name);
        EXPECT_TRUE(output->open(path(name).string(), spec)) << output->geterror();
        EXPECT_TRUE(output->write_image(OIIO::BaseTypeFromC<T>::value, values.data())) << output->geterror();
        EXPECT_TRUE(output->close());
        return path(name);
    }

    std::string refusal(const std::filesystem::path& file) const {
        try {
            readImage(file);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    }

  private:
    std::filesystem::path folder_;
};

ImageBuffer makeCrop() {
    ImageBuffer image({3, 4, 8, 6});
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        const double value = static_cast<double>(i);
        image.rgba[i] = {value / 8.0, -0.25 * value, 100.0 + value, 1.0 - value / 16.0};
        image.edge[i] = i % 3 == 0 ? 1.0f : 0.0f;
    }
    return image;
}

WriteOptions ofWhole(int width, int height) {
    WriteOptions options;
    options.width = width;
    options.height = height;
    return options;
}

TEST_F(ReadImage, ExrComesBackWithItsWindowAndEdges) {
    const ImageBuffer written = makeCrop();
    writeImage(path("a.exr"), written, ofWhole(20, 10));
    const ImageBuffer read = readImage(path("a.exr"));
    EXPECT_EQ(read.box.x0, 3);
    EXPECT_EQ(read.box.y0, 4);
    EXPECT_EQ(read.box.x1, 8);
    EXPECT_EQ(read.box.y1, 6);
    EXPECT_EQ(read.rgba, written.rgba);  // all of them are floats
    EXPECT_EQ(read.edge, written.edge);
}

TEST_F(ReadImage, ExrOfOthersHasNoEdges) {
    OIIO::ImageSpec spec(2, 1, 3, OIIO::TypeDesc::HALF);
    spec.channelnames = {"B", "G", "R"};
    const ImageBuffer read =
        readImage(writeOther("b.exr", spec, std::vector<float>{0.25f, 0.5f, 1.0f, 4.0f, 5.0f, 6.0f}));
    EXPECT_EQ(read.rgba[0], glm::dvec4(1.0, 0.5, 0.25, 1.0));
    EXPECT_EQ(read.rgba[1], glm::dvec4(6.0, 5.0, 4.0, 1.0));
    EXPECT_TRUE(read.edge.empty());
}

TEST_F(ReadImage, TiledAndGreyExrsAreRead) {
    OIIO::ImageSpec spec(20, 18, 1, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"Y"};
    spec.tile_width = spec.tile_height = 16;
    std::vector<float> values(20 * 18);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
    const auto output = OIIO::ImageOutput::create("tiled.exr");
    ASSERT_TRUE(output->open(path("tiled.exr").string(), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    ASSERT_TRUE(output->close());
    const ImageBuffer read = readImage(path("tiled.exr"));
    for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_EQ(read.rgba[i], glm::dvec4(values[i], values[i], values[i], 1.0));
}

TEST_F(ReadImage, PngIsDecodedToTheDouble) {
    const ImageBuffer eight = readImage(writeOther("a.png", OIIO::ImageSpec(2, 1, 3, OIIO::TypeDesc::UINT8),
                                                   std::vector<unsigned char>{0, 10, 188, 255, 1, 2}));
    EXPECT_EQ(eight.rgba[0], glm::dvec4(0.0, decodeSrgb(10 / 255.0), decodeSrgb(188 / 255.0), 1.0));
    EXPECT_EQ(eight.rgba[1].r, 1.0);
    EXPECT_TRUE(eight.edge.empty());
    const ImageBuffer sixteen =
        readImage(writeOther("b.png", OIIO::ImageSpec(1, 1, 4, OIIO::TypeDesc::UINT16),
                             std::vector<unsigned short>{1000, 30000, 65535, 65535}));
    EXPECT_EQ(sixteen.rgba[0], glm::dvec4(decodeSrgb(1000 / 65535.0), decodeSrgb(30000 / 65535.0), 1.0, 1.0));
    const ImageBuffer grey = readImage(writeOther("c.png", OIIO::ImageSpec(1, 1, 1, OIIO::TypeDesc::UINT8),
                                                  std::vector<unsigned char>{128}));
    EXPECT_EQ(grey.rgba[0], glm::dvec4(glm::dvec3(decodeSrgb(128 / 255.0)), 1.0));
}

TEST_F(ReadImage, WhatIsNoPictureIsRefusedByName) {
    EXPECT_NE(refusal(path("none.exr")).find("none.exr: no such file"), std::string::npos);
    std::ofstream(path("text.png")) << "P6";
    EXPECT_NE(refusal(path("text.png")).find("text.png: is neither EXR nor PNG"), std::string::npos);
    OIIO::ImageSpec spec(2, 1, 2, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"U", "V"};
    const auto motion = writeOther("uv.exr", spec, std::vector<float>{0, 0, 0, 0});
    EXPECT_NE(refusal(motion).find("uv.exr: has no channels R, G and B"), std::string::npos);
}

// Cut anywhere, it is refused and not half read.
TEST_F(ReadImage, CutOffFilesAreRefused) {
    ImageBuffer image({0, 0, 64, 48});
    for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = glm::dvec4(double(i * i % 977));
    for (const char* name : {"a.exr", "a.png"}) {
        writeImage(path(name), image, ofWhole(64, 48));
        const auto size = std::filesystem::file_size(path(name));
        for (const double share : {0.9, 0.5, 0.1, 0.02}) {
            std::filesystem::resize_file(path(name), static_cast<std::uintmax_t>(double(size) * share));
            const std::string why = refusal(path(name));
            EXPECT_NE(why.find(name), std::string::npos) << share << ' ' << why;
            EXPECT_EQ(why.find('\n'), std::string::npos) << why;
        }
    }
}

}  // namespace
}  // namespace edgewise
