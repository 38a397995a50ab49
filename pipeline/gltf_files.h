// What a glTF's URIs may reach: base64 data, and regular files in the scene's own folder and below it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tinygltf {
class Model;
}

namespace edgewise {

struct GltfDocument;

inline bool isDataUri(std::string_view uri) {
    return uri.starts_with("data:");
}

struct Base64Data {
    std::string_view payload;
    std::uint64_t decoded_bytes = 0;
};

/// The payload of "data:*;base64,...". Throws InputError naming `where` if it is anything else.
Base64Data base64Payload(std::string_view uri, const std::string& where);

/// The file a relative URI means. Throws InputError naming `where` for a scheme, an absolute path, a "..",
/// a backslash, a bad percent code, or a link that leads out of `folder`. The file need not exist.
std::filesystem::path jailedPath(const std::filesystem::path& folder, std::string_view uri,
                                 const std::string& where);

/// True if `path`, with all links followed, lies in `folder` (canonical).
bool liesInFolder(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Runs tinygltf over a document that checkGltf accepted. Files are read through the jail only; images keep
/// their encoded bytes (an external image that cannot be read keeps none); buffers without data (has_data, as
/// checkBuffers gives it) get a few bytes that nothing reads. Animations, skins, materials and cameras stay
/// out: they are read from the document. Consumes the document's binary chunk.
tinygltf::Model readModel(GltfDocument& document, const std::vector<bool>& has_data);

}  // namespace edgewise
