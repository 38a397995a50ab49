// PNG files for tests, uncompressed: every byte of the picture is chosen by the test.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace edgewise::test {

inline void appendBigEndian(std::string& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
}

inline std::uint32_t crc32(const std::string& bytes) {
    std::uint32_t crc = ~0u;
    for (const char c : bytes) {
        crc ^= static_cast<std::uint8_t>(c);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
    }
    return ~crc;
}

inline std::uint32_t adler32(const std::string& bytes) {
    std::uint32_t a = 1, b = 0;
    for (const char c : bytes) {
        a = (a + static_cast<std::uint8_t>(c)) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

inline std::string pngChunk(const std::string& name, const std::string& body) {
    std::string out;
    appendBigEndian(out, static_cast<std::uint32_t>(body.size()));
    out += name + body;
    appendBigEndian(out, crc32(name + body));
    return out;
}

/// One stored deflate block: fewer than 65,536 bytes.
inline std::string zlibStored(const std::string& bytes) {
    const auto size = static_cast<std::uint32_t>(bytes.size());
    std::string out("\x78\x01\x01", 3);
    const std::array<std::uint32_t, 4> header{size & 255u, size >> 8u, ~size & 255u, (~size >> 8u) & 255u};
    for (const std::uint32_t part : header) out += static_cast<char>(part);
    out += bytes;
    appendBigEndian(out, adler32(bytes));
    return out;
}

/// `samples` row by row; 16-bit samples as two bytes, the high one first. colour_type: 0 grey, 2 RGB, 6 RGBA.
inline std::string tinyPng(std::uint32_t width, std::uint32_t height, int bit_depth, int colour_type,
                           const std::string& samples) {
    std::string header, rows;
    appendBigEndian(header, width);
    appendBigEndian(header, height);
    header += {static_cast<char>(bit_depth), static_cast<char>(colour_type), 0, 0, 0};
    const std::size_t row_bytes = samples.size() / height;
    for (std::size_t y = 0; y < height; ++y) {
        rows += '\0';
        rows += samples.substr(y * row_bytes, row_bytes);
    }
    std::string png = "\x89PNG\r\n\x1a\n";
    png += pngChunk("IHDR", header);
    png += pngChunk("IDAT", zlibStored(rows));
    png += pngChunk("IEND", "");
    return png;
}

}  // namespace edgewise::test
