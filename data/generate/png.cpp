#include "data/generate/png.h"

#include <cassert>

namespace edgewise::scenes {
namespace {

std::string bigEndian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((value >> shift) & 0xffu);
    return bytes;
}

/// CRC-32 of ISO 3309, bit by bit.
std::uint32_t crc32(const std::string& bytes) {
    std::uint32_t crc = 0xffffffffu;
    for (const unsigned char byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
    }
    return ~crc;
}

std::uint32_t adler32(const std::string& bytes) {
    std::uint32_t a = 1, b = 0;
    for (const unsigned char byte : bytes) {
        a = (a + byte) % 65521u;
        b = (b + a) % 65521u;
    }
    return (b << 16) | a;
}

std::string chunk(const std::string& type, const std::string& data) {
    return bigEndian(static_cast<std::uint32_t>(data.size())) + type + data + bigEndian(crc32(type + data));
}

/// A zlib stream of one stored block.
std::string stored(const std::string& data) {
    assert(data.size() <= 0xffffu);
    const auto low = static_cast<char>(data.size() & 0xffu);
    const auto high = static_cast<char>(data.size() >> 8);
    const std::string header{
        '\x78', '\x01', '\x01', low, high, static_cast<char>(~low), static_cast<char>(~high)};
    return header + data + bigEndian(adler32(data));
}

}  // namespace

std::string pngBytes(int width, int height, const std::vector<Rgb8>& texels) {
    std::string rows;
    for (int y = 0; y < height; ++y) {
        rows += '\0';  // no row filter
        for (int x = 0; x < width; ++x) {
            for (const std::uint8_t value : texels[static_cast<std::size_t>(y * width + x)])
                rows += static_cast<char>(value);
        }
    }
    const std::string header = bigEndian(static_cast<std::uint32_t>(width)) +
                               bigEndian(static_cast<std::uint32_t>(height)) + std::string{8, 2, 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

}  // namespace edgewise::scenes
