#include "pipeline/decode_webp.h"

#include <webp/decode.h>

#include "pipeline/error.h"

namespace edgewise {

WebpPixels decodeWebp(std::span<const std::uint8_t> webp,
                      const std::function<void(std::uint64_t, std::uint64_t)>& check_size,
                      const std::string& what) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(webp.data(), webp.size(), &features) != VP8_STATUS_OK)
        throw InputError(what, "is a WebP that is damaged or cut off");
    if (features.has_animation != 0) throw InputError(what, "is an animated WebP");
    check_size(static_cast<std::uint64_t>(features.width), static_cast<std::uint64_t>(features.height));
    WebpPixels pixels{features.width, features.height, {}};
    const int row_bytes = 4 * features.width;
    pixels.rgba.resize(static_cast<std::size_t>(row_bytes) * static_cast<std::size_t>(features.height));
    if (WebPDecodeRGBAInto(webp.data(), webp.size(), pixels.rgba.data(), pixels.rgba.size(), row_bytes) ==
        nullptr)
        throw InputError(what, "is a WebP that is damaged or cut off");
    return pixels;
}

}  // namespace edgewise
