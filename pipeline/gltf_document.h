// A glTF file as read from disk: its JSON, and the binary chunk of a .glb. Nothing in it is trusted yet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace edgewise {

/// Stated limits.
inline constexpr std::uint64_t kMaxJsonBytes = 0x20000000;
inline constexpr int kMaxJsonDepth = 256;

struct GltfDocument {
    std::string source;            ///< the file as the user named it, free of control characters
    std::filesystem::path folder;  ///< canonical; URIs are looked up in it and nowhere else
    nlohmann::json root;
    std::vector<std::uint8_t> binary_chunk;
    bool is_binary = false;
};

/// Reads a .gltf or .glb (told apart by their first bytes), checks the container and the JSON's syntax.
/// Throws InputError naming the file and the rule; FailureError past a stated limit.
GltfDocument readGltfDocument(const std::filesystem::path& path);

/// The deepest nesting of arrays and objects in JSON text, valid or not; stops counting above `limit`.
int jsonDepth(std::string_view text, int limit);

}  // namespace edgewise
