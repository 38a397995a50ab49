// Lossless WebP files for tests: one colour, written bit by bit, no encoder asked.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace edgewise::test {

/// VP8L: every one of the five prefix codes has a single symbol, so that pixels take no bits at all.
/// argb: alpha, red, green, blue.
inline std::string tinyWebp(std::uint32_t width, std::uint32_t height,
                            const std::array<std::uint8_t, 4>& argb) {
    std::string bits;
    const auto put = [&](std::uint32_t value, int count) {
        for (int i = 0; i < count; ++i) bits += static_cast<char>(value >> i & 1);
    };
    put(0x2f, 8);
    put(width - 1, 14);
    put(height - 1, 14);
    put(argb[0] != 255, 1);  // alpha is used
    put(0, 3);               // version
    put(0, 1);               // no transform
    put(0, 1);               // no colour cache
    put(0, 1);               // one prefix-code group
    for (const std::uint32_t symbol : {argb[2], argb[1], argb[3], argb[0], std::uint8_t{0}}) {
        put(1, 1);  // a simple code
        put(0, 1);  // of one symbol
        put(1, 1);  // of 8 bits
        put(symbol, 8);
    }
    std::string body;
    for (std::size_t i = 0; i < bits.size(); i += 8) {
        int byte = 0;
        for (std::size_t k = 0; k < 8 && i + k < bits.size(); ++k) byte |= bits[i + k] << k;
        body += static_cast<char>(byte);
    }
    const auto littleEndian = [](std::size_t value) {
        std::string out;
        for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 255);
        return out;
    };
    std::string chunk = "VP8L" + littleEndian(body.size()) + body;
    if (chunk.size() % 2 != 0) chunk += '\0';
    return "RIFF" + littleEndian(chunk.size() + 4) + "WEBP" + chunk;
}

}  // namespace edgewise::test
