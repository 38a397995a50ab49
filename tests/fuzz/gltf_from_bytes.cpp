#include "tests/fuzz/gltf_from_bytes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "pipeline/error.h"
#include "pipeline/load_gltf.h"

namespace edgewise::fuzz {
namespace {

void appendUint32(std::string& out, std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 255);
}

void appendChunk(std::string& out, std::size_t type, std::string body, char padding) {
    body.resize((body.size() + 3) / 4 * 4, padding);
    appendUint32(out, body.size());
    appendUint32(out, type);
    out += body;
}

/// In memory where there is such a folder.
std::filesystem::path scratchFile() {
    const std::filesystem::path shared = "/dev/shm";
    const auto folder = (std::filesystem::exists(shared) ? shared : std::filesystem::temp_directory_path()) /
                        fmt::format("edgewise_fuzz_{}", ::getpid());
    std::filesystem::create_directories(folder);
    return folder / "input.glb";
}

template <class Vector>
bool allFinite(const std::vector<Vector>& values) {
    return std::all_of(values.begin(), values.end(), [](const Vector& v) {
        for (int i = 0; i < Vector::length(); ++i)
            if (!std::isfinite(v[i])) return false;
        return true;
    });
}

bool fits(const TextureUse& use, const Geometry& geometry, const Scene& scene) {
    if (!use.present()) return true;
    return use.texture < scene.textures.size() && scene.textures[use.texture].image < scene.images.size() &&
           geometry.uv[static_cast<std::size_t>(use.uv)].size() == geometry.position_world.size();
}

std::string checkGeometry(const Geometry& g, const Scene& scene) {
    const std::size_t vertices = g.position_world.size();
    for (const auto& triangle : g.triangles)
        for (const std::uint32_t vertex : triangle)
            if (vertex >= vertices) return "a triangle's vertex is out of range";
    if (!allFinite(g.position_world) || !allFinite(g.position_file)) return "a position is not finite";
    if (!allFinite(g.normal_world) || !allFinite(g.tangent_world)) return "a direction is not finite";
    if (!allFinite(g.uv[0]) || !allFinite(g.uv[1]) || !allFinite(g.color))
        return "an attribute is not finite";
    for (const std::size_t size : {g.normal_world.size(), g.tangent_world.size(), g.color.size()})
        if (size != 0 && size != vertices) return "an attribute has another count than the positions";
    if (g.material >= scene.materials.size()) return "a material is out of range";
    const Material& m = scene.materials[g.material];
    for (const TextureUse* use :
         {&m.base_color_map, &m.metallic_roughness_map, &m.normal_map, &m.occlusion_map, &m.emissive_map})
        if (!fits(*use, g, scene)) return "a texture, image or its coordinates are missing";
    return {};
}

std::string checkScene(const Scene& scene) {
    std::size_t triangles = 0;
    for (const Geometry& geometry : scene.geometry) {
        if (geometry.first_triangle != triangles) return "triangles are not numbered in order";
        triangles += geometry.triangles.size();
        if (std::string wrong = checkGeometry(geometry, scene); !wrong.empty()) return wrong;
    }
    if (triangles != scene.triangle_count) return "triangles are not all counted";
    for (const Image& image : scene.images)
        if (image.texels.size() != std::size_t(image.width) * std::size_t(image.height) ||
            image.texels.empty())
            return "an image has another size than its texels";
    return {};
}

}  // namespace

std::string gltfFromBytes(std::span<const std::uint8_t> bytes) {
    const std::string text(bytes.begin(), bytes.end());
    const std::size_t zero = text.find('\0');
    if (!text.starts_with("{") || zero == std::string::npos) return text;
    std::string chunks;
    appendChunk(chunks, 0x4e4f534a, text.substr(0, zero), ' ');
    appendChunk(chunks, 0x004e4942, text.substr(zero + 1), '\0');
    std::string file = "glTF";
    appendUint32(file, 2);
    appendUint32(file, chunks.size() + 12);
    return file + chunks;
}

Scene loadBytes(std::span<const std::uint8_t> bytes) {
    static const std::filesystem::path path = scratchFile();
    const std::string file = gltfFromBytes(bytes);
    std::ofstream(path, std::ios::binary) << file;
    LoadOptions options;
    options.limits = {.triangles = 1 << 16, .vertices = 1 << 16, .image_texels = 1 << 14};
    if (file.find("\"animations\"") != std::string::npos) options.time = 0.4;
    return loadGltf(path, options);
}

std::string checkLoad(std::span<const std::uint8_t> bytes) {
    try {
        return checkScene(loadBytes(bytes));
    } catch (const InputError&) {
    } catch (const FailureError&) {
    }
    return {};
}

}  // namespace edgewise::fuzz
