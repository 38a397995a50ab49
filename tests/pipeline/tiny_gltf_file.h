// Small glTF files for tests: a JSON root to edit, one growing buffer, and three ways to write them down.
#pragma once

#include <unistd.h>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace edgewise::test {

/// A folder of its own that goes when the test ends.
class TempFolder {
  public:
    TempFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "edgewise-test-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path_ = std::filesystem::canonical(pattern);
    }
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

inline void writeFile(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

inline std::string base64(const std::string& bytes) {
    static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
        for (int shift = 18; shift >= 0; shift -= 6) text += digits[group >> shift & 63];
        for (std::size_t k = bytes.size() - i; k < 3; ++k) text[text.size() - 3 + k] = '=';
    }
    return text;
}

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
constexpr int componentType() {
    if constexpr (std::is_same_v<T, std::int8_t>)
        return 5120;
    else if constexpr (std::is_same_v<T, std::uint8_t>)
        return 5121;
    else if constexpr (std::is_same_v<T, std::int16_t>)
        return 5122;
    else if constexpr (std::is_same_v<T, std::uint16_t>)
        return 5123;
    else if constexpr (std::is_same_v<T, std::uint32_t>)
        return 5125;
    else
        return 5126;
}

inline std::string chunk(std::uint32_t type, std::string bytes, char padding) {
    bytes.resize((bytes.size() + 3) / 4 * 4, padding);
    std::string out;
    append(out, static_cast<std::uint32_t>(bytes.size()));
    append(out, type);
    return out + bytes;
}

inline std::string glb(const std::string& chunks) {
    std::string file = "glTF";
    append(file, std::uint32_t{2});
    append(file, static_cast<std::uint32_t>(chunks.size() + 12));
    return file + chunks;
}

/// Starts as one scene with one node with one mesh with the triangle (0,0,0), (1,0,0), (0,1,0).
class TinyGltf {
  public:
    nlohmann::json root = nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "scene": 0,
        "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]})");
    std::string buffer;
    std::size_t placeholder_bytes = 0;  ///< more than 0: there is a second buffer, which has no data

    TinyGltf() { accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0}); }

    nlohmann::json& primitive() { return root["meshes"][0]["primitives"][0]; }

    int view(const std::string& bytes) {
        buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
        root["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
        buffer += bytes;
        return static_cast<int>(root["bufferViews"].size()) - 1;
    }

    template <class T>
    int view(const std::vector<T>& numbers) {
        std::string bytes;
        for (const T& number : numbers) append(bytes, number);
        return view(bytes);
    }

    template <class T>
    int accessor(const std::string& type, const std::vector<T>& numbers, bool normalized = false) {
        const std::size_t width = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
        nlohmann::json made{{"bufferView", view(numbers)},
                            {"componentType", componentType<T>()},
                            {"count", numbers.size() / width},
                            {"type", type}};
        if (normalized) made["normalized"] = true;
        root["accessors"].push_back(made);
        return static_cast<int>(root["accessors"].size()) - 1;
    }

    std::string asGltf() const {
        nlohmann::json copy = root;
        if (!buffer.empty() && !copy.contains("buffers"))
            copy["buffers"] = {{{"byteLength", buffer.size()},
                                {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
        addPlaceholder(copy);
        return copy.dump();
    }

    /// The JSON of a GLB, whose first buffer is the binary chunk.
    nlohmann::json glbRoot() const {
        nlohmann::json copy = root;
        if (!copy.contains("buffers")) copy["buffers"] = {{{"byteLength", buffer.size()}}};
        addPlaceholder(copy);
        return copy;
    }

    std::string asGlb() const {
        return glb(chunk(0x4e4f534a, glbRoot().dump(), ' ') + chunk(0x004e4942, buffer, '\0'));
    }

  private:
    void addPlaceholder(nlohmann::json& copy) const {
        if (placeholder_bytes > 0) copy["buffers"].push_back({{"byteLength", placeholder_bytes}});
    }
};

}  // namespace edgewise::test
