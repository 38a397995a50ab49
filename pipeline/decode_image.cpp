#include "pipeline/decode_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/error.h"
#include "pipeline/png_chunks.h"

namespace edgewise {
namespace {

/// OpenImageIO's reader. Nothing but the two formats of glTF gets that far.
const char* readerName(std::span<const std::uint8_t> bytes, const std::string& what) {
    constexpr std::array<std::uint8_t, 8> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    constexpr std::array<std::uint8_t, 3> jpeg{0xff, 0xd8, 0xff};
    const auto startsWith = [&](const auto& magic) {
        return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
    };
    if (startsWith(png)) return "png";
    if (startsWith(jpeg)) return "jpeg";
    throw InputError(what, bytes.empty() ? "cannot be read" : "is neither PNG nor JPEG");
}

struct Samples {
    int width = 0, height = 0, channels = 0;
    double largest = 255.0;
    std::vector<std::uint16_t> values;
};

void needSize(const OIIO::ImageSpec& spec, const std::string& what) {
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) throw InputError(what, "has no pixels");
    const std::uint64_t texels =
        static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height);
    if (texels > kMaxImageTexels)
        throw FailureError(
            what, fmt::format("{} x {} pixels, the limit is {}", spec.width, spec.height, kMaxImageTexels));
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

Samples readSamples(const char* name, std::vector<std::uint8_t> bytes, const std::string& what) {
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    const auto input = openInput(name, memory, what);
    const OIIO::ImageSpec& spec = input->spec();
    needSize(spec, what);
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

std::vector<float> linearTable(double largest) {
    std::vector<float> table(static_cast<std::size_t>(largest) + 1);
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = static_cast<float>(linearFromSrgb(static_cast<double>(i) / largest));
    return table;
}

}  // namespace

double linearFromSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Image decodeSrgbImage(std::span<const std::uint8_t> bytes, const std::string& what) {
    const std::string name = readerName(bytes, what);
    const Samples samples =
        readSamples(name.c_str(),
                    name == "png" ? pixelChunks(bytes, what) : std::vector(bytes.begin(), bytes.end()), what);
    const std::vector<float> linear = linearTable(samples.largest);
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
