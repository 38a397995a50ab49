#include "data/generate/gltf_file.h"

#include <algorithm>
#include <bit>

namespace edgewise::scenes {
namespace {

constexpr int kVertexTarget = 34962, kIndexTarget = 34963, kNoTarget = 0;
constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;

void putInteger(std::string& bytes, std::uint32_t value, int width) {
    for (int i = 0; i < width; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xffu);
}

void padTo4(std::string& bytes, char filler) {
    while (bytes.size() % 4 != 0) bytes += filler;
}

std::string base64(const std::string& bytes) {
    static const char* const kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group = (group << 8) | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[(group >> (18 - 6 * k)) & 63u] : '=';
    }
    return text;
}

/// Least and greatest of each component, as the file's floats: what a reader finds is what is stated.
Json bound(const std::vector<float>& values, int components, bool greatest) {
    Json result = Json::array();
    for (int c = 0; c < components; ++c) {
        float best = values[static_cast<std::size_t>(c)];
        for (std::size_t i = static_cast<std::size_t>(c); i < values.size();
             i += static_cast<std::size_t>(components)) {
            best = greatest ? std::max(best, values[i]) : std::min(best, values[i]);
        }
        result.push_back(static_cast<double>(best));
    }
    return result;
}

std::vector<float> flat(const std::vector<Vec3>& vectors) {
    std::vector<float> values;
    for (const Vec3& v : vectors) {
        for (const double c : {v.x, v.y, v.z}) values.push_back(static_cast<float>(c));
    }
    return values;
}

std::vector<float> flat(const std::vector<Vec2>& vectors) {
    std::vector<float> values;
    for (const Vec2& v : vectors) {
        for (const double c : {v.x, v.y}) values.push_back(static_cast<float>(c));
    }
    return values;
}

std::string chunk(const std::string& type, const std::string& data) {
    std::string bytes;
    putInteger(bytes, static_cast<std::uint32_t>(data.size()), 4);
    return bytes + type + data;
}

}  // namespace

GltfFile::GltfFile() {
    json_["asset"] = {{"version", "2.0"},
                      {"generator", "edgewise make_scenes " + std::to_string(kGeneratorVersion)}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", Json::array()}}});
}

int GltfFile::add(const char* array, Json element) {
    json_[array].push_back(std::move(element));
    return static_cast<int>(json_[array].size()) - 1;
}

int GltfFile::addView(const std::string& bytes, int target) {
    padTo4(binary_, '\0');
    Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    if (target != kNoTarget) view["target"] = target;
    binary_ += bytes;
    return add("bufferViews", std::move(view));
}

int GltfFile::addAccessor(const std::string& bytes, int target, Json accessor) {
    accessor["bufferView"] = addView(bytes, target);
    return add("accessors", std::move(accessor));
}

int GltfFile::addFloats(const std::vector<float>& values, int components) {
    std::string bytes;
    for (const float value : values) putInteger(bytes, std::bit_cast<std::uint32_t>(value), 4);
    return addAccessor(bytes, kVertexTarget,
                       {{"componentType", kFloat},
                        {"type", "VEC" + std::to_string(components)},
                        {"count", values.size() / static_cast<std::size_t>(components)},
                        {"min", bound(values, components, false)},
                        {"max", bound(values, components, true)}});
}

int GltfFile::addIndices(const std::vector<std::uint32_t>& index) {
    // 65,535 itself is the primitive restart value: it must not appear as a 16-bit index.
    const std::uint32_t last = *std::max_element(index.begin(), index.end());
    const bool narrow = last < 0xffffu;
    std::string bytes;
    for (const std::uint32_t i : index) putInteger(bytes, i, narrow ? 2 : 4);
    return addAccessor(bytes, kIndexTarget,
                       {{"componentType", narrow ? kUnsignedShort : kUnsignedInt},
                        {"type", "SCALAR"},
                        {"count", index.size()},
                        {"min", {*std::min_element(index.begin(), index.end())}},
                        {"max", {last}}});
}

Json GltfFile::addAttributes(const Mesh& mesh) {
    Json attributes;
    attributes["POSITION"] = addFloats(flat(mesh.position), 3);
    if (!mesh.normal.empty()) attributes["NORMAL"] = addFloats(flat(mesh.normal), 3);
    if (!mesh.uv.empty()) attributes["TEXCOORD_0"] = addFloats(flat(mesh.uv), 2);
    if (!mesh.color.empty()) {
        std::string bytes;
        for (const Rgba8& color : mesh.color) bytes.append(color.begin(), color.end());
        attributes["COLOR_0"] = addAccessor(bytes, kVertexTarget,
                                            {{"componentType", kUnsignedByte},
                                             {"normalized", true},
                                             {"type", "VEC4"},
                                             {"count", mesh.color.size()}});
    }
    return attributes;
}

Json GltfFile::addPrimitive(const Mesh& mesh, int material) {
    Json primitive = {{"attributes", addAttributes(mesh)}, {"material", material}};
    if (!mesh.index.empty()) primitive["indices"] = addIndices(mesh.index);
    return primitive;
}

int GltfFile::addImage(const std::string& png) {
    return add("images", {{"bufferView", addView(png, kNoTarget)}, {"mimeType", "image/png"}});
}

int GltfFile::addTexture(int image, Json sampler) {
    return add("textures", {{"sampler", add("samplers", std::move(sampler))}, {"source", image}});
}

int GltfFile::addMaterial(Json material) {
    return add("materials", std::move(material));
}

int GltfFile::addMesh(Json primitives) {
    return add("meshes", {{"primitives", std::move(primitives)}});
}

int GltfFile::addCamera(Json camera) {
    return add("cameras", std::move(camera));
}

int GltfFile::addNode(Json node) {
    const int index = add("nodes", std::move(node));
    json_["scenes"][0]["nodes"].push_back(index);
    return index;
}

void GltfFile::use(const std::string& extension) {
    Json& used = json_["extensionsUsed"];
    if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
}

std::string GltfFile::glb() const {
    Json json = json_;
    json["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    std::string text = json.dump(), binary = binary_;
    padTo4(text, ' ');
    padTo4(binary, '\0');
    const std::string chunks = chunk("JSON", text) + chunk(std::string("BIN\0", 4), binary);
    std::string header = "glTF";
    putInteger(header, 2, 4);
    putInteger(header, static_cast<std::uint32_t>(12 + chunks.size()), 4);
    return header + chunks;
}

std::string GltfFile::gltf() const {
    Json json = json_;
    const std::string uri = "data:application/octet-stream;base64," + base64(binary_);
    json["buffers"] = Json::array({{{"byteLength", binary_.size()}, {"uri", uri}}});
    return json.dump(1) + "\n";
}

}  // namespace edgewise::scenes
