// What a WebP says of its size, before its decoder makes room for it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace edgewise {

struct WebpSize {
    std::uint64_t width = 0, height = 0;
};

/// The canvas of a WebP (its signature already recognised) by its first chunk: VP8 (lossy), VP8L (lossless)
/// or VP8X (extended). Throws InputError naming `what` if the file is cut off before it, or is an animation.
WebpSize webpSize(std::span<const std::uint8_t> webp, const std::string& what);

}  // namespace edgewise
