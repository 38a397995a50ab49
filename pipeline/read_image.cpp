#include "pipeline/read_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/decode_image.h"
#include "pipeline/error.h"
#include "pipeline/read_file.h"
#include "pipeline/srgb.h"

namespace edgewise {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 4> kExrMagic{0x76, 0x2f, 0x31, 0x01};

bool isExr(Bytes bytes) {
    return bytes.size() >= kExrMagic.size() && std::ranges::equal(bytes.first(kExrMagic.size()), kExrMagic);
}

/// Where an EXR's channels are, counted from `first`, the first one that is read.
struct Channels {
    std::array<int, 3> rgb{};
    std::optional<int> alpha, edge;
    int first = 0, end = 0;
};

Channels findChannels(const OIIO::ImageSpec& spec, const std::string& what) {
    const auto index = [&](const char* name) { return spec.channelindex(name); };
    std::array<int, 5> found{index("R"), index("G"), index("B"), index("A"), index("edge")};
    const bool is_grey = index("Y") >= 0 && index("RY") < 0;  // with RY it holds chroma
    if (std::ranges::count(found.begin(), found.begin() + 3, -1) == 3 && is_grey)
        std::fill_n(found.begin(), 3, index("Y"));
    if (std::ranges::count(found.begin(), found.begin() + 3, -1) > 0)
        throw InputError(what, "has no channels R, G and B");
    Channels channels;
    channels.end = *std::ranges::max_element(found) + 1;
    channels.first = channels.end;
    for (const int channel : found)
        if (channel >= 0) channels.first = std::min(channels.first, channel);
    for (std::size_t c = 0; c < 3; ++c) channels.rgb[c] = found[c] - channels.first;
    if (found[3] >= 0) channels.alpha = found[3] - channels.first;
    if (found[4] >= 0) channels.edge = found[4] - channels.first;
    return channels;
}

void requireSize(std::uint64_t width, std::uint64_t height, const std::string& what) {
    if (width * height > kMaxPicturePixels)
        throw FailureError(what,
                           fmt::format("{} x {} pixels, the limit is {}", width, height, kMaxPicturePixels));
}

ImageBuffer fromFloats(const float* values, const PixelBox& box, const Channels& channels) {
    ImageBuffer image(box);
    if (!channels.edge) image.edge.clear();
    const auto stride = static_cast<std::size_t>(channels.end - channels.first);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        const float* pixel = values + i * stride;
        image.rgba[i] = {pixel[channels.rgb[0]], pixel[channels.rgb[1]], pixel[channels.rgb[2]],
                         channels.alpha ? pixel[*channels.alpha] : 1.0};
        if (channels.edge) image.edge[i] = pixel[*channels.edge];
    }
    return image;
}

ImageBuffer readExr(Bytes bytes, const std::string& what) {
    OIIO::Filesystem::IOMemReader reader(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
    const auto input = OIIO::ImageInput::open("picture.exr", nullptr, &reader);
    if (!input) throw InputError(what, "is a damaged EXR: " + OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.deep) throw InputError(what, "is a deep EXR");
    const Channels channels = findChannels(spec, what);
    requireSize(static_cast<std::uint64_t>(spec.width), static_cast<std::uint64_t>(spec.height), what);
    // Left as it comes: what the file does not fill takes no memory.
    const auto values =
        std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(spec.image_pixels()) *
                                                static_cast<std::size_t>(channels.end - channels.first));
    if (!input->read_image(0, 0, channels.first, channels.end, OIIO::TypeDesc::FLOAT, values.get()))
        throw InputError(what, "is a damaged EXR: " + input->geterror());
    return fromFloats(values.get(), {spec.x, spec.y, spec.x + spec.width, spec.y + spec.height}, channels);
}

/// The linear value of every number that a sample may be.
std::vector<double> linearValues(std::uint16_t largest) {
    std::vector<double> table(std::size_t{largest} + 1);
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = decodeSrgb(static_cast<double>(i) / largest);
    return table;
}

ImageBuffer readEncoded(Bytes bytes, const std::string& what) {
    const PictureSamples samples = decodeSamples(bytes, kMaxPicturePixels, what);
    const std::vector<double> linear = linearValues(samples.largest);
    const auto channels = static_cast<std::size_t>(samples.channels);
    const bool is_grey = channels < 3, has_alpha = channels % 2 == 0;
    ImageBuffer image({0, 0, samples.width, samples.height});
    image.edge.clear();
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        const std::uint16_t* value = &samples.values[i * channels];
        image.rgba[i] = {linear[value[0]], linear[value[is_grey ? 0 : 1]], linear[value[is_grey ? 0 : 2]],
                         has_alpha ? double(value[channels - 1]) / samples.largest : 1.0};
    }
    return image;
}

}  // namespace

ImageBuffer readImage(const std::filesystem::path& path) {
    const std::string what = path.string();
    const std::vector<std::uint8_t> bytes = readWholeFile(path, what);
    if (isExr(bytes)) return readExr(bytes, what);
    if (!isKnownPicture(bytes)) throw InputError(what, "is neither EXR nor PNG");
    return readEncoded(bytes, what);
}

}  // namespace edgewise
