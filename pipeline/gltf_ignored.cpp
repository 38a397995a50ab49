#include "pipeline/gltf_ignored.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "pipeline/gltf_check.h"

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

void addMaterials(const Json& root, std::vector<Ignored>& list) {
    constexpr std::array known{"OPAQUE", "MASK", "BLEND"};
    add(list, "unknown alpha modes", countIf(section(root, "materials"), [&](const Json& material) {
            const std::string mode = material.value("alphaMode", "OPAQUE");
            return std::find(known.begin(), known.end(), mode) == known.end();
        }));
}

/// Beyond positions, normals and tangents.
bool changesLooks(const Json& target) {
    for (const auto& [name, accessor] : target.items())
        if (name.starts_with("TEXCOORD_") || name.starts_with("COLOR_")) return true;
    return false;
}

void addPrimitives(const Json& root, std::vector<Ignored>& list) {
    constexpr std::array kinds{"point primitives", "line primitives", "line primitives", "line primitives"};
    for (const Json& mesh : section(root, "meshes"))
        for (const Json& primitive : section(mesh, "primitives")) {
            const std::size_t mode = primitive.value("mode", std::size_t{4});
            if (mode < kinds.size())
                add(list, kinds[mode], 1);
            else if (mode > 6)
                add(list, "primitives of an unknown mode", 1);
            else if (!primitive["attributes"].contains("POSITION"))
                add(list, "primitives without positions", 1);
            add(list, "primitives whose morph targets change texture coordinates or colours",
                countIf(section(primitive, "targets"), changesLooks) > 0);
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
    std::map<std::string, std::size_t> uses;
    countExtensions(root, uses);
    for (const auto& [name, count] : uses)
        if (!isSupportedExtension(name)) add(list, "extension " + name, count);
    return list;
}

void countIgnored(Scene& scene, std::string_view what, std::size_t count) {
    add(scene.ignored, what, count);
}

}  // namespace edgewise
