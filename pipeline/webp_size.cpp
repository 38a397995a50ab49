#include "pipeline/webp_size.h"

#include <string_view>

#include "pipeline/error.h"

namespace edgewise {
namespace {

constexpr std::size_t kBody = 20;  // "RIFF" size "WEBP", then the first chunk's name and size
constexpr std::size_t kLongestHead = 10;

std::uint32_t littleEndian(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value |= std::uint32_t(bytes[at + i]) << (8 * i);
    return value;
}

}  // namespace

WebpSize webpSize(std::span<const std::uint8_t> webp, const std::string& what) {
    constexpr std::uint32_t k14Bits = 0x3fff, kAnimated = 2;
    if (webp.size() < kBody + kLongestHead) throw InputError(what, "is a WebP that is cut off");
    const std::string_view name(reinterpret_cast<const char*>(webp.data()) + 12, 4);
    if (name == "VP8 ")
        return {littleEndian(webp, kBody + 6, 2) & k14Bits, littleEndian(webp, kBody + 8, 2) & k14Bits};
    if (name == "VP8L") {
        const std::uint32_t bits = littleEndian(webp, kBody + 1, 4);
        return {(bits & k14Bits) + 1, (bits >> 14 & k14Bits) + 1};
    }
    if (name != "VP8X") throw InputError(what, "is a WebP whose first chunk is no picture");
    if ((webp[kBody] & kAnimated) != 0) throw InputError(what, "is an animated WebP");
    return {littleEndian(webp, kBody + 4, 3) + 1, littleEndian(webp, kBody + 7, 3) + 1};
}

}  // namespace edgewise
