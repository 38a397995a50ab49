// A second reader of glTF for tests of the files themselves: no checks but the test's own, no part of
// load_gltf.
#pragma once

#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace edgewise::test {

struct PlainGltf {
    nlohmann::json json;
    std::string binary;
};

inline std::uint32_t littleEndian(const std::string& bytes, std::size_t at, std::size_t width) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < width; ++i)
        value |= std::uint32_t{static_cast<unsigned char>(bytes.at(at + i))} << (8 * i);
    return value;
}

inline std::string fromBase64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t group = 0, bits = 0;
    for (const char c : text.substr(0, text.find('='))) {
        group = (group << 6) | static_cast<std::uint32_t>(digits.find(c));
        if ((bits += 6) >= 8) bytes += static_cast<char>((group >> (bits -= 8)) & 0xffu);
    }
    return bytes;
}

inline PlainGltf readPlain(const std::string& bytes) {
    if (bytes.compare(0, 4, "glTF") != 0) {
        PlainGltf text{nlohmann::json::parse(bytes), ""};
        const std::string uri = text.json["buffers"][0]["uri"];
        text.binary = fromBase64(uri.substr(uri.find(',') + 1));
        return text;
    }
    const std::size_t length = littleEndian(bytes, 12, 4);
    return {nlohmann::json::parse(bytes.substr(20, length)), bytes.substr(28 + length)};
}

inline std::vector<std::uint32_t> readIndices(const PlainGltf& file, const nlohmann::json& accessor) {
    const std::size_t offset =
        file.json["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteOffset"];
    const std::size_t width = accessor["componentType"] == 5123 ? 2 : 4;
    std::vector<std::uint32_t> values;
    for (std::size_t i = 0; i < accessor["count"]; ++i)
        values.push_back(littleEndian(file.binary, offset + i * width, width));
    return values;
}

using Point = std::array<float, 3>;

inline std::vector<Point> readPoints(const PlainGltf& file, const nlohmann::json& accessor) {
    const std::size_t offset =
        file.json["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteOffset"];
    std::vector<Point> points(accessor["count"].get<std::size_t>());
    std::memcpy(points.data(), &file.binary.at(offset), points.size() * sizeof(Point));
    return points;
}

using Triangle = std::array<Point, 3>;

/// The triangles of every node in index order, as in the file: node transforms are not applied.
inline std::vector<Triangle> readTriangles(const PlainGltf& file) {
    std::vector<Triangle> triangles;
    for (const auto& node : file.json["nodes"]) {
        if (!node.contains("mesh")) continue;
        for (const auto& primitive : file.json["meshes"][node["mesh"].get<std::size_t>()]["primitives"]) {
            const auto& accessors = file.json["accessors"];
            const auto points =
                readPoints(file, accessors[primitive["attributes"]["POSITION"].get<std::size_t>()]);
            std::vector<std::uint32_t> index;
            if (primitive.contains("indices"))
                index = readIndices(file, accessors[primitive["indices"].get<std::size_t>()]);
            else
                for (std::uint32_t i = 0; i < points.size(); ++i) index.push_back(i);
            for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
                triangles.push_back({points.at(index[i]), points.at(index[i + 1]), points.at(index[i + 2])});
            }
        }
    }
    return triangles;
}

}  // namespace edgewise::test
