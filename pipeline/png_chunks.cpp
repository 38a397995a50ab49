#include "pipeline/png_chunks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <string_view>

#include "pipeline/error.h"

namespace edgewise {
namespace {

constexpr std::size_t kSignatureBytes = 8, kChunkFrameBytes = 12;  // length, name, checksum

std::uint32_t bigEndian(std::span<const std::uint8_t> bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes[at + i];
    return value;
}

bool makesPixels(std::string_view name) {
    constexpr std::array<std::string_view, 5> kept{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
    return std::find(kept.begin(), kept.end(), name) != kept.end();
}

/// The chunk at the start of `rest`, frame included.
std::span<const std::uint8_t> firstChunk(std::span<const std::uint8_t> rest, const std::string& what) {
    if (rest.size() < kChunkFrameBytes || bigEndian(rest, 0) > rest.size() - kChunkFrameBytes)
        throw InputError(what, "is a PNG that is cut off");
    return rest.first(bigEndian(rest, 0) + kChunkFrameBytes);
}

void checkSum(std::span<const std::uint8_t> chunk, std::string_view name, const std::string& what) {
    boost::crc_32_type crc;  // over name and data
    crc.process_bytes(chunk.data() + 4, chunk.size() - 8);
    if (crc.checksum() != bigEndian(chunk, chunk.size() - 4))
        throw InputError(what, fmt::format("is a PNG whose chunk {} is damaged", name));
}

}  // namespace

std::vector<std::uint8_t> pixelChunks(std::span<const std::uint8_t> png, const std::string& what) {
    std::vector<std::uint8_t> kept(png.begin(), png.begin() + kSignatureBytes);
    bool has_data = false;
    for (auto rest = png.subspan(kSignatureBytes);;) {
        const auto chunk = firstChunk(rest, what);
        const std::string_view name(reinterpret_cast<const char*>(chunk.data()) + 4, 4);
        rest = rest.subspan(chunk.size());
        if ((name == "IHDR") != (kept.size() == kSignatureBytes))
            throw InputError(what, "is a PNG whose header is not its first chunk");
        if (!makesPixels(name)) continue;
        has_data = has_data || name == "IDAT";
        if (name == "IEND" && !has_data) throw InputError(what, "is a PNG without pixels");
        checkSum(chunk, name, what);
        kept.insert(kept.end(), chunk.begin(), chunk.end());
        if (name == "IEND") return kept;
    }
}

}  // namespace edgewise
