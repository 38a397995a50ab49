#include "pipeline/decode_image.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "pipeline/decode_jpeg.h"
#include "pipeline/decode_png.h"
#include "pipeline/decode_webp.h"
#include "pipeline/error.h"
#include "pipeline/png_chunks.h"
#include "pipeline/srgb.h"

namespace edgewise {
namespace {

bool hasAt(std::span<const std::uint8_t> bytes, std::size_t at, std::string_view text) {
    return bytes.size() >= at + text.size() &&
           std::equal(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

/// Which of the formats it is; empty for any other.
std::string_view formatName(std::span<const std::uint8_t> bytes) {
    if (hasAt(bytes, 0, "\x89PNG\r\n\x1a\n")) return "png";
    if (hasAt(bytes, 0, "\xff\xd8\xff")) return "jpeg";
    if (hasAt(bytes, 0, "RIFF") && hasAt(bytes, 8, "WEBP")) return "webp";
    return {};
}

/// Texels that a byte of the file can hold at most. PNG: deflate expands by no more than 1032, and a byte of
/// a row holds 8 one-bit texels. JPEG: a block of 8 x 8 takes a bit at least, and chroma shares what luma
/// takes. WebP: no bound, lossless pictures of one colour take no bits a texel.
std::uint64_t texelsPerByte(std::string_view name) {
    if (name == "png") return 1032 * 8;
    return name == "jpeg" ? 8 * 64 : std::numeric_limits<std::uint32_t>::max();
}

/// Every value a sample may have, linear in [0, 1].
std::vector<float> linearTable(double largest, ColorEncoding encoding) {
    std::vector<float> table(static_cast<std::size_t>(largest) + 1);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double value = static_cast<double>(i) / largest;
        table[i] = static_cast<float>(encoding == ColorEncoding::kSrgb ? decodeSrgb(value) : value);
    }
    return table;
}

}  // namespace

bool isKnownPicture(std::span<const std::uint8_t> bytes) {
    return !formatName(bytes).empty();
}

PictureSamples decodeSamples(std::span<const std::uint8_t> bytes, std::uint64_t max_texels,
                             const std::string& what) {
    const std::string_view name = formatName(bytes);
    if (name.empty())
        throw InputError(what, bytes.empty() ? "cannot be read" : "is neither PNG, JPEG nor WebP");
    const SizeCheck check_size = [&](std::uint64_t width, std::uint64_t height) {
        if (width * height > max_texels)
            throw FailureError(what,
                               fmt::format("{} x {} pixels, the limit is {}", width, height, max_texels));
        if (width * height > bytes.size() * texelsPerByte(name))
            throw InputError(what, fmt::format("{} x {} pixels are more than its bytes hold", width, height));
    };
    if (name == "webp") return decodeWebp(bytes, check_size, what);
    if (name == "png") return decodePng(pixelChunks(bytes, what), check_size, what);
    return decodeJpeg(bytes, check_size, what);
}

Image decodeImage(std::span<const std::uint8_t> bytes, ColorEncoding encoding, std::uint64_t max_texels,
                  const std::string& what) {
    const PictureSamples samples = decodeSamples(bytes, max_texels, what);
    const std::vector<float> linear = linearTable(samples.largest, encoding);
    const auto channels = static_cast<std::size_t>(samples.channels);
    const bool is_grey = channels < 3, has_alpha = channels % 2 == 0;
    Image image;
    image.width = samples.width;
    image.height = samples.height;
    image.texels.resize(samples.values.size() / channels);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        const std::uint16_t* value = &samples.values[i * channels];
        const double alpha = has_alpha ? value[channels - 1] / double(samples.largest) : 1.0;
        image.texels[i] = {linear[value[0]], linear[value[is_grey ? 0 : 1]], linear[value[is_grey ? 0 : 2]],
                           static_cast<float>(alpha)};
    }
    return image;
}

}  // namespace edgewise
