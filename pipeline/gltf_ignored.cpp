#include "pipeline/gltf_ignored.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

namespace edgewise {
namespace {

using Json = nlohmann::json;

void add(std::vector<Ignored>& list, std::string_view what, std::size_t count) {
    if (count == 0) return;
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Ignored& entry) { return entry.what == what; });
    if (found == list.end())
        list.push_back({std::string(what), count});
    else
        found->count += count;
}

const Json& section(const Json& root, const char* key) {
    static const Json nothing = Json::array();
    const auto found = root.find(key);
    return found == root.end() ? nothing : *found;
}

template <class Has>
std::size_t countIf(const Json& list, const Has& has) {
    return static_cast<std::size_t>(std::count_if(list.begin(), list.end(), has));
}

bool emits(const Json& material) {
    if (material.contains("emissiveTexture")) return true;
    const Json& factor = section(material, "emissiveFactor");
    return std::any_of(factor.begin(), factor.end(), [](const Json& value) { return value != 0.0; });
}

void addMaterials(const Json& root, std::vector<Ignored>& list) {
    const Json& materials = section(root, "materials");
    const auto alpha = [](const char* mode) {
        return [mode](const Json& material) { return material.value("alphaMode", "OPAQUE") == mode; };
    };
    const auto has = [](const char* key) {
        return [key](const Json& material) { return material.contains(key); };
    };
    add(list, "alpha mode MASK", countIf(materials, alpha("MASK")));
    add(list, "alpha mode BLEND", countIf(materials, alpha("BLEND")));
    add(list, "emissive materials", countIf(materials, emits));
    add(list, "metallic-roughness textures", countIf(materials, [](const Json& material) {
            return section(material, "pbrMetallicRoughness").contains("metallicRoughnessTexture");
        }));
    add(list, "normal textures", countIf(materials, has("normalTexture")));
    add(list, "occlusion textures", countIf(materials, has("occlusionTexture")));
}

void addPrimitives(const Json& root, std::vector<Ignored>& list) {
    constexpr std::array kinds{"point primitives", "line primitives", "line primitives", "line primitives"};
    for (const Json& mesh : section(root, "meshes"))
        for (const Json& primitive : section(mesh, "primitives")) {
            const std::size_t mode = primitive.value("mode", std::size_t{4});
            if (mode < kinds.size())
                add(list, kinds[mode], 1);
            else if (!primitive["attributes"].contains("POSITION"))
                add(list, "primitives without positions", 1);
            if (!section(primitive, "targets").empty()) add(list, "primitives with morph targets", 1);
            if (primitive["attributes"].contains("COLOR_1")) add(list, "primitives with a second colour", 1);
        }
}

/// Every use of an extension counts, declared or not. The depth of the JSON is bounded, so this may recurse.
void countExtensions(const Json& value, std::map<std::string, std::size_t>& uses) {
    if (value.is_object() && value.contains("extensions") && value["extensions"].is_object())
        for (const auto& [name, body] : value["extensions"].items()) ++uses[name];
    if (value.is_structured())
        for (const auto& [key, child] : value.items())
            if (key != "extras") countExtensions(child, uses);
}

}  // namespace

std::vector<Ignored> listIgnored(const Json& root) {
    std::vector<Ignored> list;
    addMaterials(root, list);
    addPrimitives(root, list);
    add(list, "skinned nodes",
        countIf(section(root, "nodes"), [](const Json& node) { return node.contains("skin"); }));
    add(list, "animations", section(root, "animations").size());
    std::map<std::string, std::size_t> uses;
    countExtensions(root, uses);
    for (const auto& [name, count] : uses)
        if (name != "KHR_materials_unlit") add(list, "extension " + name, count);
    return list;
}

void countIgnored(Scene& scene, std::string_view what, std::size_t count) {
    add(scene.ignored, what, count);
}

}  // namespace edgewise
