#include "tests/property/world_scene.h"

#include <cmath>

#include "pipeline/load_gltf.h"
#include "pipeline/resolve_camera.h"
#include "tests/pipeline/tiny_gltf_file.h"

namespace edgewise::property {
namespace {

using nlohmann::json;

constexpr double kHalf = kFilmPx / 2.0;
constexpr double kEyeZ = -0.25;

json camera(Lens lens) {
    if (lens == Lens::kPerspective)
        return {{"type", "perspective"},
                {"perspective", {{"yfov", 2 * std::atan(kHalf)}, {"znear", 0.015625}, {"zfar", 1024}}}};
    return {{"type", "orthographic"},
            {"orthographic", {{"xmag", kHalf}, {"ymag", kHalf}, {"znear", 0}, {"zfar", 1024}}}};
}

json material() {
    return {{"doubleSided", true}, {"extensions", {{"KHR_materials_unlit", json::object()}}}};
}

/// Colours that differ for the first 255 triangles: owners of one colour would be merged.
std::array<float, 3> colorOf(std::size_t triangle) {
    const auto k = static_cast<float>(triangle + 1);
    return {k / 256, static_cast<float>(triangle * 89 % 256) / 256, 0.5f};
}

/// The triangles [begin, end) as a node's mesh.
void addNode(const WorldScene& scene, std::size_t begin, std::size_t end, test::TinyGltf& file) {
    std::vector<float> position, color;
    for (std::size_t i = begin; i < end; ++i)
        for (const glm::vec3& p : scene.triangles[i].p_world) {
            position.insert(position.end(), {p.x, p.y, p.z});
            for (const float c : colorOf(i)) color.push_back(c);
        }
    const int positions = file.accessor("VEC3", position), colors = file.accessor("VEC3", color);
    file.root["nodes"].push_back({{"mesh", file.root["meshes"].size()}});
    file.root["meshes"].push_back(
        {{"primitives",
          {{{"attributes", {{"POSITION", positions}, {"COLOR_0", colors}}}, {"material", 0}}}}});
}

}  // namespace

std::string gltfOf(const WorldScene& scene) {
    test::TinyGltf file;
    for (const char* list : {"accessors", "bufferViews", "nodes", "meshes"}) file.root[list] = json::array();
    file.buffer.clear();
    file.root["extensionsUsed"] = {"KHR_materials_unlit"};
    file.root["materials"] = {material()};
    file.root["cameras"] = {camera(scene.lens)};
    const auto& triangles = scene.triangles;
    for (std::size_t begin = 0, end = 0; begin < triangles.size(); begin = end) {
        while (end < triangles.size() && triangles[end].node == triangles[begin].node) ++end;
        addNode(scene, begin, end, file);
    }
    const double eye_z = scene.lens == Lens::kPerspective ? kEyeZ : 0.0;
    file.root["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, eye_z}}});
    file.root["scenes"][0]["nodes"] = json::array();
    for (std::size_t i = 0; i < file.root["nodes"].size(); ++i) file.root["scenes"][0]["nodes"].push_back(i);
    return file.asGltf();
}

WorldScene readWorld(const std::filesystem::path& gltf) {
    const Scene scene = loadGltf(gltf);
    WorldScene world;
    world.lens = scene.cameras.at(0).perspective ? Lens::kPerspective : Lens::kOrthographic;
    for (const Geometry& g : scene.geometry)
        for (const auto& [a, b, c] : g.triangles)
            world.triangles.push_back(
                {{g.position_file[a], g.position_file[b], g.position_file[c]}, static_cast<int>(g.node)});
    return world;
}

View viewOf(const std::filesystem::path& gltf, const PixelBox& crop) {
    View view;
    view.scene = loadGltf(gltf);
    CameraOptions options;
    options.size = glm::ivec2(kFilmPx, kFilmPx);
    view.camera = resolveCamera(view.scene, options, view.film);
    view.film.crop = crop;
    return view;
}

View viewOf(const WorldScene& scene, const PixelBox& crop) {
    const test::TempFolder folder;
    test::writeFile(folder / "scene.gltf", gltfOf(scene));
    return viewOf(folder / "scene.gltf", crop);
}

}  // namespace edgewise::property
