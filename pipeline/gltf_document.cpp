#include "pipeline/gltf_document.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>

#include "pipeline/error.h"
#include "pipeline/read_file.h"

namespace edgewise {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's binary data is read as it lies");

constexpr std::uint32_t kGlbMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

using Bytes = std::span<const std::uint8_t>;

std::uint32_t readUint32(Bytes bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

struct Chunk {
    std::uint32_t type = 0;
    Bytes bytes;
    std::size_t end = 0;
};

Chunk readChunk(const std::string& source, Bytes file, std::size_t offset, int index) {
    const std::string where = fmt::format("{}: GLB chunk {}", source, index);
    if (file.size() - offset < 8) throw InputError(where, "its header is cut off by the end of the file");
    const std::uint32_t length = readUint32(file, offset);
    if (length > file.size() - offset - 8)
        throw InputError(where, fmt::format("has length {}, but only {} bytes of the file are left", length,
                                            file.size() - offset - 8));
    if (length % 4 != 0) throw InputError(where, fmt::format("has length {}, not a multiple of 4", length));
    return {readUint32(file, offset + 4), file.subspan(offset + 8, length), offset + 8 + length};
}

void checkGlbHeader(const std::string& source, Bytes file, std::uint64_t file_size) {
    const std::string where = source + ": GLB header";
    if (file.size() < 12) throw InputError(where, "the file is shorter than 12 bytes");
    if (readUint32(file, 4) != 2)
        throw InputError(where, fmt::format("version {} is not supported, only 2", readUint32(file, 4)));
    if (readUint32(file, 8) != file_size)
        throw InputError(where,
                         fmt::format("says {} bytes, the file has {}", readUint32(file, 8), file_size));
}

/// Chunks after the binary one belong to extensions and are skipped, as the specification asks.
std::string_view splitGlb(GltfDocument& document, Bytes file) {
    checkGlbHeader(document.source, file, file.size());
    const Chunk json_chunk = readChunk(document.source, file, 12, 0);
    if (json_chunk.type != kJsonChunk)
        throw InputError(document.source + ": GLB chunk 0",
                         fmt::format("has type 0x{:08x}, not JSON", json_chunk.type));
    for (std::size_t offset = json_chunk.end, index = 1; offset < file.size(); ++index) {
        const Chunk chunk = readChunk(document.source, file, offset, static_cast<int>(index));
        if (chunk.type == kBinaryChunk && index == 1)
            document.binary_chunk.assign(chunk.bytes.begin(), chunk.bytes.end());
        offset = chunk.end;
    }
    document.is_binary = true;
    return {reinterpret_cast<const char*>(json_chunk.bytes.data()), json_chunk.bytes.size()};
}

/// nlohmann's message without its "[json.exception...]" tag.
std::string parserMessage(const nlohmann::json::exception& error) {
    const std::string text = error.what();
    const std::size_t tag_end = text.find("] ");
    return tag_end == std::string::npos ? text : text.substr(tag_end + 2);
}

nlohmann::json parseJson(const std::string& source, std::string_view text) {
    if (text.size() > kMaxJsonBytes)
        throw FailureError(source + ": JSON",
                           fmt::format("{} bytes, the limit is {}", text.size(), kMaxJsonBytes));
    if (jsonDepth(text, kMaxJsonDepth) > kMaxJsonDepth)
        throw InputError(source + ": JSON", fmt::format("is nested deeper than {} levels", kMaxJsonDepth));
    try {
        nlohmann::json root = nlohmann::json::parse(text.begin(), text.end());
        if (!root.is_object()) throw InputError(source + ": JSON", "the file's root is not an object");
        return root;
    } catch (const nlohmann::json::exception& error) {
        throw InputError(source + ": JSON", parserMessage(error));
    }
}

/// Before all of a large file is read: does it start like a GLB of its size, or like a JSON object?
void checkBeginning(const std::filesystem::path& path, const std::string& source) {
    std::array<char, 256> bytes{};
    std::ifstream stream(path, std::ios::binary);
    stream.read(bytes.data(), bytes.size());
    const std::string_view found(bytes.data(), static_cast<std::size_t>(stream.gcount()));
    if (found.size() < 4) throw InputError(source, "is neither glTF nor GLB: shorter than 4 bytes");
    if (found.starts_with("glTF")) {
        const auto* begin = reinterpret_cast<const std::uint8_t*>(found.data());
        return checkGlbHeader(source, {begin, found.size()}, std::filesystem::file_size(path));
    }
    const std::size_t first = found.find_first_not_of(" \t\r\n", found.starts_with("\xef\xbb\xbf") ? 3 : 0);
    if (first != std::string_view::npos && found[first] != '{' && found[first] != '[')
        throw InputError(source, "is neither glTF nor GLB: it starts with neither { nor glTF");
}

}  // namespace

int jsonDepth(std::string_view text, int limit) {
    int depth = 0, deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size() && deepest <= limit; ++i) {
        const char c = text[i];
        if (in_string && c == '\\')
            ++i;
        else if (c == '"')
            in_string = !in_string;
        else if (!in_string && (c == '{' || c == '['))
            deepest = std::max(deepest, ++depth);
        else if (!in_string && (c == '}' || c == ']'))
            --depth;
    }
    return deepest;
}

GltfDocument readGltfDocument(const std::filesystem::path& path) {
    GltfDocument document;
    document.source = oneLine(path.string());
    needRegularFile(path, document.source);
    checkBeginning(path, document.source);
    const std::vector<std::uint8_t> file = readWholeFile(path, document.source);
    document.folder = std::filesystem::canonical(path.has_parent_path() ? path.parent_path() : ".");
    if (file.size() < 4) throw InputError(document.source, "is neither glTF nor GLB: shorter than 4 bytes");
    const bool is_glb = readUint32(file, 0) == kGlbMagic;
    const std::string_view text =
        is_glb ? splitGlb(document, file)
               : std::string_view(reinterpret_cast<const char*>(file.data()), file.size());
    document.root = parseJson(document.source, text);
    return document;
}

}  // namespace edgewise
