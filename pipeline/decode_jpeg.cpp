#include "pipeline/decode_jpeg.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <memory>

#include "pipeline/error.h"

namespace edgewise {
namespace {

std::string decoderMessage(const OIIO::ImageInput& input) {
    const std::string message = input.geterror();
    return message.empty() ? "cannot be decoded" : message;
}

}  // namespace

PictureSamples decodeJpeg(std::span<const std::uint8_t> jpeg, const SizeCheck& check_size,
                          const std::string& what) {
    std::vector<std::uint8_t> bytes(jpeg.begin(), jpeg.end());
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    const auto input = OIIO::ImageInput::create("jpeg");
    if (!input) throw FailureError(what, "this OpenImageIO has no reader for jpeg");
    OIIO::ImageSpec spec;
    if (!input->set_ioproxy(&memory) || !input->open(what, spec))
        throw InputError(what, decoderMessage(*input));
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) throw InputError(what, "has no pixels");
    check_size(static_cast<std::uint64_t>(spec.width), static_cast<std::uint64_t>(spec.height));
    PictureSamples picture{spec.width, spec.height, std::min(spec.nchannels, 4), 0xff, {}};
    std::vector<std::uint8_t> values(static_cast<std::size_t>(spec.width) *
                                     static_cast<std::size_t>(spec.height) *
                                     static_cast<std::size_t>(picture.channels));
    if (!input->read_image(0, 0, 0, picture.channels, OIIO::TypeDesc::UINT8, values.data()))
        throw InputError(what, decoderMessage(*input));
    picture.values.assign(values.begin(), values.end());
    return picture;
}

}  // namespace edgewise
