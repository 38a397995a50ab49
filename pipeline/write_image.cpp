#include "pipeline/write_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "pipeline/atomic_file.h"
#include "pipeline/error.h"
#include "pipeline/srgb.h"

namespace edgewise {
namespace {

/// x, y of red, green, blue and white of Rec.709, as OpenEXR stores them.
constexpr std::array<float, 8> kRec709{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
constexpr int kExrChannels = 5;
constexpr int kPngChannels = 3;

/// Pixel `index` of the box, for messages.
std::string pixelName(const PixelBox& box, std::size_t index) {
    const std::size_t width = static_cast<std::size_t>(box.width());
    return fmt::format("pixel {},{}", box.x0 + static_cast<int>(index % width),
                       box.y0 + static_cast<int>(index / width));
}

void requireFinite(const PixelBox& box, std::size_t index, double value) {
    if (!std::isfinite(value))
        throw FailureError(pixelName(box, index), fmt::format("is {}, not a number", value));
}

/// The bits of every pixel's channels: float32, and uint32 where an AOV is a whole number.
std::vector<std::uint32_t> exrPixels(const ImageBuffer& image) {
    const auto& channels = image.aov.channels;
    std::vector<std::uint32_t> out;
    out.reserve(image.rgba.size() * (kExrChannels + channels.size()));
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        for (int c = 0; c < 4; ++c) {
            const float value = static_cast<float>(image.rgba[i][c]);
            requireFinite(image.box, i, value);
            out.push_back(floatBits(value));
        }
        out.push_back(floatBits(image.edge[i]));
        const std::uint32_t* more = image.aov.pixel(i);
        for (std::size_t c = 0; c < channels.size(); ++c) {
            if (!channels[c].whole_number) requireFinite(image.box, i, std::bit_cast<float>(more[c]));
            out.push_back(more[c]);
        }
    }
    return out;
}

std::vector<unsigned char> pngPixels(const ImageBuffer& image, double exposure_ev) {
    const double gain = std::exp2(exposure_ev);
    std::vector<unsigned char> out;
    out.reserve(image.rgba.size() * kPngChannels);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        for (int c = 0; c < kPngChannels; ++c) {
            requireFinite(image.box, i, image.rgba[i][c]);
            const double encoded = encodeSrgb(std::clamp(image.rgba[i][c] * gain, 0.0, 1.0));
            out.push_back(static_cast<unsigned char>(std::floor(encoded * 255.0 + 0.5)));
        }
    }
    return out;
}

void addAovs(OIIO::ImageSpec& spec, const AovImage& aov) {
    spec.channelformats.assign(kExrChannels, OIIO::TypeDesc::FLOAT);
    for (const AovChannel& channel : aov.channels) {
        spec.channelnames.push_back(channel.name);
        spec.channelformats.push_back(channel.whole_number ? OIIO::TypeDesc::UINT32 : OIIO::TypeDesc::FLOAT);
        if (channel.name == "Z") spec.z_channel = static_cast<int>(spec.channelnames.size()) - 1;
    }
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    for (const auto& [name, value] : aov.metadata) spec.attribute(name, value);
}

OIIO::ImageSpec exrSpec(const ImageBuffer& image, const WriteOptions& options) {
    const PixelBox& box = image.box;
    OIIO::ImageSpec spec(box.width(), box.height(), kExrChannels, OIIO::TypeDesc::FLOAT);
    spec.x = box.x0;
    spec.y = box.y0;
    spec.full_x = spec.full_y = 0;
    spec.full_width = options.width;
    spec.full_height = options.height;
    spec.channelnames = {"R", "G", "B", "A", "edge"};
    spec.alpha_channel = 3;
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("DateTime", "");  // else OpenImageIO writes the hour, and no two files are alike
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, kRec709.size()), kRec709.data());
    if (!image.aov.channels.empty()) addAovs(spec, image.aov);
    return spec;
}

OIIO::ImageSpec pngSpec(const PixelBox& box) {
    OIIO::ImageSpec spec(box.width(), box.height(), kPngChannels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    return spec;
}

void addMetadata(OIIO::ImageSpec& spec, const WriteOptions& options) {
    for (const auto& [name, value] : options.metadata) spec.attribute("edgewise:" + name, value);
}

std::vector<unsigned char> encode(const char* format, const OIIO::ImageSpec& spec, const void* pixels) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput target(bytes);
    auto output = OIIO::ImageOutput::create(format, &target);
    if (!output || !output->open(std::string("picture.") + format, spec) ||
        !output->write_image(spec.channelformats.empty() ? spec.format : OIIO::TypeDesc::UNKNOWN, pixels) ||
        !output->close())
        throw FailureError(format, output ? output->geterror() : OIIO::geterror());
    return bytes;
}

}  // namespace

ImageFormat imageFormat(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension == ".exr") return ImageFormat::kExr;
    if (extension == ".png") return ImageFormat::kPng;
    throw InputError(path.string(), "an image's name ends in .exr or .png");
}

std::vector<unsigned char> encodeImage(const ImageBuffer& image, ImageFormat format,
                                       const WriteOptions& options) {
    OIIO::ImageSpec spec = format == ImageFormat::kExr ? exrSpec(image, options) : pngSpec(image.box);
    addMetadata(spec, options);
    if (format == ImageFormat::kExr) return encode("exr", spec, exrPixels(image).data());
    return encode("png", spec, pngPixels(image, options.exposure_ev).data());
}

void writeImage(const std::filesystem::path& path, const ImageBuffer& image, const WriteOptions& options) {
    const ImageFormat format = imageFormat(path);
    writeAtomically(path, encodeImage(image, format, options));
}

}  // namespace edgewise
