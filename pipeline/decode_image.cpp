#include "pipeline/decode_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "pipeline/decode_webp.h"
#include "pipeline/error.h"
#include "pipeline/png_chunks.h"

namespace edgewise {
namespace {

bool hasAt(std::span<const std::uint8_t> bytes, std::size_t at, std::string_view text) {
    return bytes.size() >= at + text.size() &&
           std::equal(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

/// Which of the formats it is, as OpenImageIO calls them; empty for any other.
std::string_view formatName(std::span<const std::uint8_t> bytes) {
    if (hasAt(bytes, 0, "\x89PNG\r\n\x1a\n")) return "png";
    if (hasAt(bytes, 0, "\xff\xd8\xff")) return "jpeg";
    if (hasAt(bytes, 0, "RIFF") && hasAt(bytes, 8, "WEBP")) return "webp";
    return {};
}

struct Samples {
    int width = 0, height = 0, channels = 0;
    double largest = 255.0;
    std::vector<std::uint16_t> values;
};

/// Texels that a byte of the file can hold at most. PNG: deflate expands by no more than 1032, and a byte of
/// a row holds 8 one-bit texels. JPEG: a block of 8 x 8 takes a bit at least, and chroma shares what luma
/// takes. WebP: no bound, lossless pictures of one colour take no bits a texel.
std::uint64_t texelsPerByte(std::string_view name) {
    if (name == "png") return 1032 * 8;
    return name == "jpeg" ? 8 * 64 : std::numeric_limits<std::uint32_t>::max();
}

struct SizeLimits {
    std::uint64_t max_texels, max_plausible;
};

void needSize(std::uint64_t width, std::uint64_t height, const SizeLimits& limits, const std::string& what) {
    if (width * height > limits.max_texels)
        throw FailureError(what,
                           fmt::format("{} x {} pixels, the limit is {}", width, height, limits.max_texels));
    if (width * height > limits.max_plausible)
        throw InputError(what, fmt::format("{} x {} pixels are more than its bytes hold", width, height));
}

template <class T>
bool readAs(OIIO::ImageInput& input, int channels, Samples& samples) {
    std::vector<T> values(samples.values.size());
    if (!input.read_image(0, 0, 0, channels, OIIO::BaseTypeFromC<T>::value, values.data())) return false;
    std::copy(values.begin(), values.end(), samples.values.begin());
    samples.largest = std::numeric_limits<T>::max();
    return true;
}

std::string decoderMessage(OIIO::ImageInput& input) {
    const std::string message = input.geterror();
    return message.empty() ? "cannot be decoded" : message;
}

std::unique_ptr<OIIO::ImageInput> openInput(const char* name, OIIO::Filesystem::IOMemReader& memory,
                                            const std::string& what) {
    auto input = OIIO::ImageInput::create(name);
    if (!input) throw FailureError(what, fmt::format("this OpenImageIO has no reader for {}", name));
    OIIO::ImageSpec straight_alpha, spec;
    straight_alpha.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->set_ioproxy(&memory) || !input->open(what, spec, straight_alpha))
        throw InputError(what, decoderMessage(*input));
    return input;
}

Samples readSamples(const char* name, std::vector<std::uint8_t> bytes, const SizeLimits& limits,
                    const std::string& what) {
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    const auto input = openInput(name, memory, what);
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) throw InputError(what, "has no pixels");
    needSize(static_cast<std::uint64_t>(spec.width), static_cast<std::uint64_t>(spec.height), limits, what);
    Samples samples;
    samples.width = spec.width;
    samples.height = spec.height;
    samples.channels = std::min(spec.nchannels, 4);
    samples.values.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                          static_cast<std::size_t>(samples.channels));
    const bool is_8_bit = spec.format == OIIO::TypeDesc::UINT8;
    const bool done = is_8_bit ? readAs<std::uint8_t>(*input, samples.channels, samples)
                               : readAs<std::uint16_t>(*input, samples.channels, samples);
    if (!done) throw InputError(what, decoderMessage(*input));
    return samples;
}

/// Every value a sample may have, linear in [0, 1].
std::vector<float> linearTable(double largest, ColorEncoding encoding) {
    std::vector<float> table(static_cast<std::size_t>(largest) + 1);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double value = static_cast<double>(i) / largest;
        table[i] = static_cast<float>(encoding == ColorEncoding::kSrgb ? linearFromSrgb(value) : value);
    }
    return table;
}

Samples readWebp(std::span<const std::uint8_t> bytes, const SizeLimits& limits, const std::string& what) {
    const WebpPixels pixels = decodeWebp(
        bytes, [&](std::uint64_t width, std::uint64_t height) { needSize(width, height, limits, what); },
        what);
    Samples samples{pixels.width, pixels.height, 4, 255.0, {}};
    samples.values.assign(pixels.rgba.begin(), pixels.rgba.end());
    return samples;
}

Samples readPicture(std::span<const std::uint8_t> bytes, std::uint64_t max_texels, const std::string& what) {
    const std::string_view name = formatName(bytes);
    if (name.empty())
        throw InputError(what, bytes.empty() ? "cannot be read" : "is neither PNG, JPEG nor WebP");
    const SizeLimits limits{max_texels, bytes.size() * texelsPerByte(name)};
    if (name == "webp") return readWebp(bytes, limits, what);
    if (name == "png") return readSamples("png", pixelChunks(bytes, what), limits, what);
    return readSamples("jpeg", {bytes.begin(), bytes.end()}, limits, what);
}

}  // namespace

bool isKnownPicture(std::span<const std::uint8_t> bytes) {
    return !formatName(bytes).empty();
}

double linearFromSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Image decodeImage(std::span<const std::uint8_t> bytes, ColorEncoding encoding, std::uint64_t max_texels,
                  const std::string& what) {
    const Samples samples = readPicture(bytes, max_texels, what);
    const std::vector<float> linear = linearTable(samples.largest, encoding);
    const auto channels = static_cast<std::size_t>(samples.channels);
    const bool is_grey = channels < 3, has_alpha = channels % 2 == 0;
    Image image;
    image.width = samples.width;
    image.height = samples.height;
    image.texels.resize(samples.values.size() / channels);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        const std::uint16_t* value = &samples.values[i * channels];
        const double alpha = has_alpha ? value[channels - 1] / samples.largest : 1.0;
        image.texels[i] = {linear[value[0]], linear[value[is_grey ? 0 : 1]], linear[value[is_grey ? 0 : 2]],
                           static_cast<float>(alpha)};
    }
    return image;
}

}  // namespace edgewise
