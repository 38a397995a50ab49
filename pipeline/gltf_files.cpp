#include "pipeline/gltf_files.h"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <algorithm>
#include <cstring>

#include "pipeline/error.h"
#include "pipeline/gltf_document.h"
#include "pipeline/read_file.h"

namespace edgewise {
namespace {

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string percentDecoded(std::string_view uri, const std::string& where) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            text += uri[i];
            continue;
        }
        const int high = i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
        const int low = i + 2 < uri.size() ? hexDigit(uri[i + 2]) : -1;
        if (high < 0 || low < 0) throw InputError(where, "has a % without two hexadecimal digits");
        text += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return text;
}

bool hasScheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string_view::npos && uri.find('/') > colon;
}

bool isBase64(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' || c == '/';
}

bool fileExists(const std::string& path, void* folder) {
    std::error_code error;
    return liesInFolder(path, *static_cast<const std::filesystem::path*>(folder)) &&
           std::filesystem::is_regular_file(path, error);
}

bool readFile(std::vector<unsigned char>* bytes, std::string* error, const std::string& path, void* folder) {
    if (!fileExists(path, folder)) {
        *error = "not a file of the scene's folder";
        return false;
    }
    *bytes = readWholeFile(path, path);
    return true;
}

std::string sameName(const std::string& path, void*) {
    return path;
}

bool writeNothing(std::string* error, const std::string&, const std::vector<unsigned char>&, void*) {
    *error = "edgewise writes no glTF";
    return false;
}

bool keepImageBytes(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                    const unsigned char* bytes, int size, void*) {
    image->image.assign(bytes, bytes + size);
    image->as_is = true;
    return true;
}

/// tinygltf refuses indices without a buffer view, which are legal when they are sparse, compressed or all 0.
void takeIndices(nlohmann::json& root) {
    if (!root.contains("meshes")) return;
    for (auto& mesh : root["meshes"])
        for (auto& primitive : mesh["primitives"]) primitive.erase("indices");
}

void giveIndicesBack(const nlohmann::json& root, tinygltf::Model& model) {
    for (std::size_t m = 0; m < model.meshes.size(); ++m)
        for (std::size_t p = 0; p < model.meshes[m].primitives.size(); ++p)
            model.meshes[m].primitives[p].indices = root["meshes"][m]["primitives"][p].value("indices", -1);
}

/// tinygltf reads "+" as a space.
std::string withoutPlus(const std::string& uri) {
    std::string text;
    for (const char c : uri) text += c == '+' ? "%2B" : std::string(1, c);
    return text;
}

/// tinygltf knows few media types and wants byteLength to be the file's size; the specification does not.
/// checkGltf has found at least byteLength bytes, so the true size may take its place.
void rewriteUri(nlohmann::json& element, const GltfDocument& document) {
    const std::string uri = element["uri"];
    const bool is_buffer = element.contains("byteLength");
    if (isDataUri(uri)) {
        const Base64Data data = base64Payload(uri, document.source);
        if (is_buffer) element["byteLength"] = data.decoded_bytes;
        element["uri"] = fmt::format("data:application/octet-stream;base64,{}", data.payload);
        return;
    }
    if (is_buffer)
        element["byteLength"] = std::filesystem::file_size(jailedPath(document.folder, uri, document.source));
    element["uri"] = withoutPlus(uri);
}

/// tinygltf wants every buffer's bytes; a placeholder gets three.
void fillPlaceholder(nlohmann::json& buffer) {
    buffer["uri"] = "data:application/octet-stream;base64,AAAA";
    buffer["byteLength"] = 3;
}

nlohmann::json forTinygltf(const GltfDocument& document, const std::vector<bool>& has_data) {
    nlohmann::json root = document.root;
    for (const char* section : {"animations", "skins", "materials", "cameras", "extensions", "extras"})
        root.erase(section);
    for (const char* section : {"buffers", "images"}) {
        if (!root.contains(section)) continue;
        for (auto& element : root[section])
            if (element.contains("uri")) rewriteUri(element, document);
    }
    for (std::size_t i = 0; i < has_data.size(); ++i)
        if (!has_data[i]) fillPlaceholder(root["buffers"][i]);
    takeIndices(root);
    return root;
}

void appendUint32(std::vector<unsigned char>& bytes, std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<unsigned char>(value >> shift));
}

void appendChunk(std::vector<unsigned char>& glb, std::uint32_t type, const void* bytes, std::size_t size,
                 unsigned char padding) {
    const std::size_t padded = (size + 3) / 4 * 4;
    appendUint32(glb, padded);
    appendUint32(glb, type);
    const auto* begin = static_cast<const unsigned char*>(bytes);
    glb.insert(glb.end(), begin, begin + size);
    glb.insert(glb.end(), padded - size, padding);
}

std::vector<unsigned char> packGlb(const std::string& json_text, const std::vector<std::uint8_t>& binary) {
    std::vector<unsigned char> glb;
    glb.reserve(json_text.size() + binary.size() + 64);
    for (const std::uint32_t word : {0x46546c67u, 2u, 0u}) appendUint32(glb, word);
    appendChunk(glb, 0x4e4f534a, json_text.data(), json_text.size(), ' ');
    if (!binary.empty()) appendChunk(glb, 0x004e4942, binary.data(), binary.size(), 0);
    const auto length = static_cast<std::uint32_t>(glb.size());
    std::memcpy(glb.data() + 8, &length, sizeof length);
    return glb;
}

void installCallbacks(tinygltf::TinyGLTF& parser, std::filesystem::path& folder) {
    tinygltf::FsCallbacks files;
    files.FileExists = fileExists;
    files.ExpandFilePath = sameName;
    files.ReadWholeFile = readFile;
    files.WriteWholeFile = writeNothing;
    files.user_data = &folder;
    parser.SetFsCallbacks(files);
    parser.SetImageLoader(keepImageBytes, nullptr);
}

bool runTinygltf(tinygltf::Model& model, std::string& error, GltfDocument& document,
                 const std::vector<bool>& has_data) {
    tinygltf::TinyGLTF parser;
    installCallbacks(parser, document.folder);
    const std::string json_text = forTinygltf(document, has_data).dump();
    std::string warnings;
    if (!document.is_binary)
        return parser.LoadASCIIFromString(&model, &error, &warnings, json_text.data(),
                                          static_cast<unsigned>(json_text.size()), document.folder.string());
    const std::vector<unsigned char> glb = packGlb(json_text, document.binary_chunk);
    document.binary_chunk = {};
    return parser.LoadBinaryFromMemory(&model, &error, &warnings, glb.data(),
                                       static_cast<unsigned>(glb.size()), document.folder.string());
}

}  // namespace

Base64Data base64Payload(std::string_view uri, const std::string& where) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64"))
        throw InputError(where, "is a data URI that is not base64");
    Base64Data data{uri.substr(comma + 1)};
    std::string_view digits = data.payload;
    while (!digits.empty() && digits.back() == '=') digits.remove_suffix(1);
    if (!std::all_of(digits.begin(), digits.end(), isBase64) || digits.size() % 4 == 1)
        throw InputError(where, "is a data URI with broken base64");
    data.decoded_bytes = digits.size() * 3 / 4;
    return data;
}

bool liesInFolder(const std::filesystem::path& path, const std::filesystem::path& folder) {
    std::error_code error;
    const std::filesystem::path real = std::filesystem::weakly_canonical(path, error);
    if (error) return false;
    const auto [in_folder, in_real] = std::mismatch(folder.begin(), folder.end(), real.begin(), real.end());
    return in_folder == folder.end();
}

std::filesystem::path jailedPath(const std::filesystem::path& folder, std::string_view uri,
                                 const std::string& where) {
    if (uri.empty()) throw InputError(where, "is empty");
    if (hasScheme(uri)) throw InputError(where, fmt::format("\"{}\" is not a relative path", uri));
    const std::string decoded = percentDecoded(uri, where);
    const std::filesystem::path relative(decoded);
    if (relative.is_absolute()) throw InputError(where, fmt::format("\"{}\" is an absolute path", decoded));
    if (decoded.find_first_of(std::string("\\\0", 2)) != std::string::npos)
        throw InputError(where, fmt::format("\"{}\" has a backslash or a zero byte", decoded));
    const std::filesystem::path normal = relative.lexically_normal();
    if ((!normal.empty() && *normal.begin() == "..") || !liesInFolder(folder / relative, folder))
        throw InputError(where, fmt::format("\"{}\" leaves the scene's folder", decoded));
    return folder / relative;
}

tinygltf::Model readModel(GltfDocument& document, const std::vector<bool>& has_data) {
    tinygltf::Model model;
    std::string error;
    try {
        if (runTinygltf(model, error, document, has_data)) {
            giveIndicesBack(document.root, model);
            return model;
        }
    } catch (const std::out_of_range&) {
        error = "an empty image or buffer";
    }
    throw InputError(document.source, error);
}

}  // namespace edgewise
