#include "data/generate/scene_parts.h"

namespace edgewise::scenes {

int addUnlitMaterial(GltfFile& file, const std::string& name, std::array<double, 3> color,
                     bool double_sided) {
    file.use("KHR_materials_unlit");
    Json material = {{"name", name},
                     {"pbrMetallicRoughness",
                      {{"baseColorFactor", Json::array({color[0], color[1], color[2], 1.0})},
                       {"metallicFactor", 0.0},
                       {"roughnessFactor", 1.0}}},
                     {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
    if (double_sided) material["doubleSided"] = true;
    return file.addMaterial(std::move(material));
}

void addPixelCamera(GltfFile& file, double size_px) {
    const double half = 0.5 * size_px;
    const Json lens = {{"xmag", half}, {"ymag", half}, {"znear", 1.0}, {"zfar", 8191.0}};
    const int camera = file.addCamera({{"type", "orthographic"}, {"orthographic", lens}});
    file.addNode(
        {{"name", "camera"}, {"camera", camera}, {"translation", Json::array({half, half, 4096.0})}});
}

void addPerspectiveCamera(GltfFile& file, const Lens& lens, Json pose) {
    const Json perspective = {
        {"yfov", lens.yfov}, {"aspectRatio", lens.aspect}, {"znear", lens.znear}, {"zfar", lens.zfar}};
    pose["name"] = "camera";
    pose["camera"] = file.addCamera({{"type", "perspective"}, {"perspective", perspective}});
    file.addNode(std::move(pose));
}

Json rotation(Vec3 axis, double turns) {
    const Vec2 half = onCircle(0.5 * turns);
    const Vec3 v = half.y * normalized(axis);
    return Json::array({v.x, v.y, v.z, half.x});
}

void Soup::triangle(Vec3 a, Vec3 b, Vec3 c, Rgba8 color) {
    mesh_.position.insert(mesh_.position.end(), {a, b, c});
    mesh_.color.insert(mesh_.color.end(), 3, color);
}

void Soup::triangle(Vec3 a, Vec3 b, Vec3 c) {
    triangle(a, b, c, paletteColor(next_color_++));
}

void Soup::quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    triangle(a, b, c);
    triangle(a, c, d);
}

Rgba8 paletteColor(std::uint32_t i) {
    SplitMix64 random(i);
    const std::uint64_t bits = random.next();
    const auto component = [bits](int shift) {
        return static_cast<std::uint8_t>(32 + (bits >> shift) % 224u);
    };
    return {component(0), component(20), component(40), 255};
}

void addSoup(GltfFile& file, const Soup& soup, int material, Json node) {
    node["mesh"] = file.addMesh(Json::array({file.addPrimitive(soup.mesh(), material)}));
    file.addNode(std::move(node));
}

void addSoup(GltfFile& file, const Soup& soup, Json node) {
    addSoup(file, soup, addUnlitMaterial(file, "vertex colours", {1.0, 1.0, 1.0}, true), std::move(node));
}

}  // namespace edgewise::scenes
