#include "pipeline/write_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "pipeline/error.h"

namespace edgewise {
namespace {

constexpr PixelBox kBox{3, 4, 11, 9};

ImageBuffer makeImage() {
    ImageBuffer image;
    image.box = kBox;
    for (int i = 0; i < kBox.width() * kBox.height(); ++i) {
        image.rgba.emplace_back(i / 40.0, -0.25 + i, 1.0 / (1 + i), 1.0 - i / 64.0);
        image.edge.push_back(i % 3 == 0 ? 1.0f : 0.0f);
    }
    return image;
}

WriteOptions makeOptions() {
    WriteOptions options;
    options.width = 20;
    options.height = 10;
    options.metadata = {
        {"version", "1.2.3"}, {"command", "edgewise render x"}, {"device", "cpu"}, {"seed", "7"}};
    return options;
}

struct Decoded {
    OIIO::ImageSpec spec;
    std::vector<float> pixels;
};

Decoded decode(std::vector<unsigned char> bytes, const std::string& name) {
    OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
    auto input = OIIO::ImageInput::open(name, nullptr, &reader);
    EXPECT_TRUE(input) << OIIO::geterror();
    Decoded decoded{input->spec(), {}};
    decoded.pixels.resize(static_cast<std::size_t>(decoded.spec.image_pixels()) * decoded.spec.nchannels);
    EXPECT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, decoded.pixels.data()));
    return decoded;
}

TEST(WriteImage, ExrKeepsEveryFloatAndBothWindows) {
    const ImageBuffer image = makeImage();
    const Decoded read = decode(encodeImage(image, ImageFormat::kExr, makeOptions()), "a.exr");
    EXPECT_EQ(read.spec.channelnames, (std::vector<std::string>{"R", "G", "B", "A", "edge"}));
    EXPECT_EQ(read.spec.format, OIIO::TypeDesc::FLOAT);
    EXPECT_EQ(read.spec.roi(), OIIO::ROI(3, 11, 4, 9, 0, 1, 0, 5));
    EXPECT_EQ(read.spec.roi_full(), OIIO::ROI(0, 20, 0, 10, 0, 1, 0, 5));
    EXPECT_EQ(read.spec.get_string_attribute("compression"), "zip");
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        for (int c = 0; c < 4; ++c) EXPECT_EQ(read.pixels[i * 5 + c], static_cast<float>(image.rgba[i][c]));
        EXPECT_EQ(read.pixels[i * 5 + 4], image.edge[i]);
    }
}

TEST(WriteImage, ExrSaysRec709) {
    const Decoded read = decode(encodeImage(makeImage(), ImageFormat::kExr, makeOptions()), "a.exr");
    float read_back[8] = {};
    ASSERT_TRUE(
        read.spec.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), read_back));
    const float rec709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    for (int i = 0; i < 8; ++i) EXPECT_EQ(read_back[i], rec709[i]);
}

TEST(WriteImage, MetadataIsInBothFormats) {
    for (const auto& [format, name] :
         {std::pair(ImageFormat::kExr, "a.exr"), std::pair(ImageFormat::kPng, "a.png")}) {
        const Decoded read = decode(encodeImage(makeImage(), format, makeOptions()), name);
        EXPECT_EQ(read.spec.get_string_attribute("edgewise:version"), "1.2.3") << name;
        EXPECT_EQ(read.spec.get_string_attribute("edgewise:command"), "edgewise render x") << name;
        EXPECT_EQ(read.spec.get_string_attribute("edgewise:device"), "cpu") << name;
        EXPECT_EQ(read.spec.get_string_attribute("edgewise:seed"), "7") << name;
    }
}

TEST(WriteImage, TheSameImageGivesTheSameBytesASecondLater) {
    const auto exr = encodeImage(makeImage(), ImageFormat::kExr, makeOptions());
    const auto png = encodeImage(makeImage(), ImageFormat::kPng, makeOptions());
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // a clock in the file would have moved on
    EXPECT_EQ(encodeImage(makeImage(), ImageFormat::kExr, makeOptions()), exr);
    EXPECT_EQ(encodeImage(makeImage(), ImageFormat::kPng, makeOptions()), png);
}

int pngValue(double linear, double exposure_ev) {
    ImageBuffer image;
    image.box = {0, 0, 1, 1};
    image.rgba = {glm::dvec4(linear, linear, linear, 1.0)};
    image.edge = {0.0f};
    WriteOptions options;
    options.width = options.height = 1;
    options.exposure_ev = exposure_ev;
    const Decoded read = decode(encodeImage(image, ImageFormat::kPng, options), "a.png");
    EXPECT_EQ(read.spec.nchannels, 3);
    EXPECT_EQ(read.pixels[0], read.pixels[1]);
    EXPECT_EQ(read.pixels[0], read.pixels[2]);
    return static_cast<int>(std::lround(read.pixels[0] * 255.0f));
}

// By hand from IEC 61966-2-1: the straight part below 0.0031308, the power above it, ties of neither.
TEST(WriteImage, PngIsSrgbEncodedAndRoundedToNearest) {
    EXPECT_EQ(pngValue(0.0, 0), 0);
    EXPECT_EQ(pngValue(1.0, 0), 255);
    EXPECT_EQ(pngValue(0.5, 0), 188);
    EXPECT_EQ(pngValue(0.18, 0), 118);
    EXPECT_EQ(pngValue(0.0031308, 0), 10);  // 12.92 * 0.0031308 * 255 = 10.31
    EXPECT_EQ(pngValue(1.4999 / 255 / 12.92, 0), 1);
    EXPECT_EQ(pngValue(1.5001 / 255 / 12.92, 0), 2);
}

TEST(WriteImage, PngClampsAndExposes) {
    EXPECT_EQ(pngValue(-3.0, 0), 0);
    EXPECT_EQ(pngValue(7.0, 0), 255);
    EXPECT_EQ(pngValue(2.0, -2), pngValue(0.5, 0));
    EXPECT_EQ(pngValue(0.125, 2), pngValue(0.5, 0));
}

TEST(WriteImage, NonFinitePixelsAreNamed) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        ImageBuffer image = makeImage();
        image.rgba[8 + 2].y = bad;
        for (const ImageFormat format : {ImageFormat::kExr, ImageFormat::kPng}) {
            try {
                encodeImage(image, format, makeOptions());
                FAIL() << bad;
            } catch (const FailureError& error) {
                EXPECT_NE(std::string(error.what()).find("pixel 5,5"), std::string::npos) << error.what();
            }
        }
    }
}

TEST(WriteImage, WhatOverflowsFloatIsNoExr) {
    ImageBuffer image = makeImage();
    image.rgba[0].x = 1e39;
    EXPECT_THROW(encodeImage(image, ImageFormat::kExr, makeOptions()), FailureError);
}

TEST(WriteImage, ExtensionChoosesTheFormat) {
    EXPECT_EQ(imageFormat("a.exr"), ImageFormat::kExr);
    EXPECT_EQ(imageFormat("dir.exr/A.PNG"), ImageFormat::kPng);
    for (const char* name : {"a", "a.jpg", ".png.", "exr", ""})
        EXPECT_THROW(imageFormat(name), InputError) << name;
}

}  // namespace
}  // namespace edgewise
