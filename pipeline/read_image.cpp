#include "pipeline/read_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/decode_image.h"
#include "pipeline/error.h"

namespace edgewise {
namespace {

constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 30;

using Bytes = std::vector<std::uint8_t>;

Bytes readBytes(const std::filesystem::path& path) {
    std::error_code ignored;
    std::ifstream file(path, std::ios::binary);
    if (!file || std::filesystem::is_directory(path, ignored))
        throw InputError(path.string(), "cannot be opened");
    Bytes bytes{std::istreambuf_iterator<char>(file), {}};
    if (file.bad()) throw InputError(path.string(), "cannot be read");
    return bytes;
}

bool isExr(const Bytes& bytes) {
    constexpr std::array<std::uint8_t, 4> kMagic{0x76, 0x2f, 0x31, 0x01};
    return bytes.size() > kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
}

bool isPng(const Bytes& bytes) {
    return isKnownPicture(bytes) && bytes.front() == 0x89;
}

PictureFile readPng(const Bytes& bytes, const std::string& name) {
    // Decoded as they are: the curve in double gives back the very code when it is encoded again.
    const Image png = decodeImage(bytes, ColorEncoding::kLinear, kMaxPixels, name);
    PictureFile picture{ImageBuffer({0, 0, png.width, png.height}), png.width, png.height};
    for (std::size_t i = 0; i < png.texels.size(); ++i) {
        for (int c = 0; c < 3; ++c) picture.image.rgba[i][c] = linearFromSrgb(png.texels[i][c]);
        picture.image.rgba[i].a = png.texels[i].a;
    }
    return picture;
}

int channelNamed(const OIIO::ImageSpec& spec, const char* name) {
    const auto found = std::ranges::find(spec.channelnames, name);
    return found == spec.channelnames.end() ? -1 : static_cast<int>(found - spec.channelnames.begin());
}

/// Channels of red, green, blue.
std::array<int, 3> colorChannels(const OIIO::ImageSpec& spec, const std::string& name) {
    const std::array<int, 3> rgb{channelNamed(spec, "R"), channelNamed(spec, "G"), channelNamed(spec, "B")};
    if (std::ranges::min(rgb) >= 0) return rgb;
    const int grey = channelNamed(spec, "Y");
    if (grey < 0) throw InputError(name, "has neither the channels R, G and B nor Y");
    return {grey, grey, grey};
}

PictureFile emptyPicture(const OIIO::ImageSpec& spec, const std::string& name) {
    const std::uint64_t pixels = std::uint64_t(spec.width) * std::uint64_t(spec.height);
    if (pixels > kMaxPixels)
        throw FailureError(
            name, fmt::format("{} x {} pixels, the limit is {}", spec.width, spec.height, kMaxPixels));
    const int x = spec.x - spec.full_x, y = spec.y - spec.full_y;
    return {ImageBuffer({x, y, x + spec.width, y + spec.height}), spec.full_width, spec.full_height};
}

double finite(float value, const PixelBox& box, std::size_t i, const std::string& name) {
    if (std::isfinite(value)) return value;
    const std::size_t width = static_cast<std::size_t>(box.width());
    throw InputError(name,
                     fmt::format("pixel {},{} is {}, not a number", box.x0 + static_cast<int>(i % width),
                                 box.y0 + static_cast<int>(i / width), value));
}

PictureFile readExr(Bytes& bytes, const std::string& name) {
    OIIO::Filesystem::IOMemReader source(bytes.data(), bytes.size());
    const auto input = OIIO::ImageInput::open("picture.exr", nullptr, &source);
    if (!input) throw InputError(name, OIIO::geterror());
    const OIIO::ImageSpec spec = input->spec();
    PictureFile picture = emptyPicture(spec, name);
    const std::array<int, 3> color = colorChannels(spec, name);
    const int alpha = channelNamed(spec, "A"), edge = channelNamed(spec, "edge");
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> values(picture.image.rgba.size() * channels);
    if (!input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, values.data()))
        throw InputError(name, input->geterror());
    for (std::size_t i = 0; i < picture.image.rgba.size(); ++i) {
        const float* pixel = &values[i * channels];
        const auto read = [&](int c) { return finite(pixel[c], picture.image.box, i, name); };
        picture.image.rgba[i] = {read(color[0]), read(color[1]), read(color[2]),
                                 alpha < 0 ? 1.0 : read(alpha)};
        if (edge >= 0) picture.image.edge[i] = pixel[edge];
    }
    return picture;
}

}  // namespace

PictureFile readImage(const std::filesystem::path& path) {
    Bytes bytes = readBytes(path);
    if (isPng(bytes)) return readPng(bytes, path.string());
    if (isExr(bytes)) return readExr(bytes, path.string());
    throw InputError(path.string(), bytes.empty() ? "is empty" : "is neither PNG nor EXR");
}

}  // namespace edgewise
