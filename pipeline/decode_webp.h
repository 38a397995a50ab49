// WebP by its own library: OpenImageIO 2.4's reader multiplies colours by alpha, whatever it is asked.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace edgewise {

struct WebpPixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  ///< straight alpha, row 0 at the top
};

/// Decodes a still WebP, lossy or lossless. check_size(width, height) may throw before room for the pixels is
/// made. Throws InputError naming `what` for damage and for animations.
WebpPixels decodeWebp(std::span<const std::uint8_t> webp,
                      const std::function<void(std::uint64_t, std::uint64_t)>& check_size,
                      const std::string& what);

}  // namespace edgewise
