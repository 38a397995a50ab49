#include "pipeline/decode_webp.h"

#include <webp/decode.h>

#include "pipeline/error.h"

namespace edgewise {

PictureSamples decodeWebp(std::span<const std::uint8_t> webp, const SizeCheck& check_size,
                          const std::string& what) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(webp.data(), webp.size(), &features) != VP8_STATUS_OK)
        throw InputError(what, "is a WebP that is damaged or cut off");
    if (features.has_animation != 0) throw InputError(what, "is an animated WebP");
    check_size(static_cast<std::uint64_t>(features.width), static_cast<std::uint64_t>(features.height));
    const int row_bytes = 4 * features.width;
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(row_bytes) *
                                   static_cast<std::size_t>(features.height));
    if (WebPDecodeRGBAInto(webp.data(), webp.size(), rgba.data(), rgba.size(), row_bytes) == nullptr)
        throw InputError(what, "is a WebP that is damaged or cut off");
    return {features.width, features.height, 4, 0xff, {rgba.begin(), rgba.end()}};
}

}  // namespace edgewise
