// A decoded picture before its numbers mean anything: what the decoders of the formats give.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace edgewise {

struct PictureSamples {
    int width = 0, height = 0;
    int channels = 1;  ///< grey, grey and alpha, RGB, RGBA; alpha is straight
    std::uint16_t largest = 255;
    std::vector<std::uint16_t> values;  ///< row 0 at the top
};

/// Called with width and height before room for the pixels is made; may throw.
using SizeCheck = std::function<void(std::uint64_t width, std::uint64_t height)>;

}  // namespace edgewise
