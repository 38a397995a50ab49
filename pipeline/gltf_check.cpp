#include "pipeline/gltf_check.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "pipeline/gltf_document.h"

namespace edgewise {
namespace {

constexpr std::array<std::string_view, 10> kSupported{
    "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression", "EXT_texture_webp",
    "KHR_draco_mesh_compression", "KHR_lights_punctual",     "KHR_materials_emissive_strength",
    "KHR_materials_unlit",        "KHR_mesh_quantization",   "KHR_meshopt_compression",
    "KHR_texture_transform",
};

struct Version {
    int major = 0, minor = 0;
};

Version parseVersion(const GltfElement& element) {
    const std::string text = element.string();
    Version version;
    const char* const end = text.data() + text.size();
    const auto major = std::from_chars(text.data(), end, version.major);
    if (major.ec != std::errc() || major.ptr == end || *major.ptr != '.')
        element.fail(fmt::format("\"{}\" is not a version like 2.0", text));
    const auto minor = std::from_chars(major.ptr + 1, end, version.minor);
    if (minor.ec != std::errc() || minor.ptr != end)
        element.fail(fmt::format("\"{}\" is not a version like 2.0", text));
    return version;
}

void checkAsset(const GltfElement& root) {
    const GltfElement asset = root.need("asset").object();
    const GltfElement version = asset.need("version");
    if (parseVersion(version).major != 2)
        version.fail(fmt::format("{} is not supported, only 2.x", version.string()));
    const auto least = asset.find("minVersion");
    if (!least) return;
    const Version needed = parseVersion(*least);
    if (needed.major != 2 || needed.minor > 0)
        least->fail(fmt::format("{} is needed, only 2.0 is supported", least->string()));
}

void checkExtensions(const GltfElement& root) {
    root.each("extensionsUsed", [](const GltfElement& name) { name.string(); });
    root.each("extensionsRequired", [](const GltfElement& name) {
        const std::string text = name.string();
        if (!isSupportedExtension(text))
            name.fail(fmt::format("the file requires the extension {}, which is not supported", text));
    });
}

std::size_t sectionSize(const GltfElement& root, const char* key) {
    const auto section = root.find(key);
    if (!section) return 0;
    section->array();
    for (std::size_t i = 0; i < section->size(); ++i) {
        const GltfElement element = section->at(i);
        element.object();
        if (const auto name = element.find("name")) name->string();
        if (const auto extensions = element.find("extensions")) extensions->object();
    }
    return section->size();
}

GltfCounts countSections(const GltfElement& root) {
    sectionSize(root, "animations");
    return {.accessors = sectionSize(root, "accessors"),
            .buffers = sectionSize(root, "buffers"),
            .buffer_views = sectionSize(root, "bufferViews"),
            .cameras = sectionSize(root, "cameras"),
            .images = sectionSize(root, "images"),
            .materials = sectionSize(root, "materials"),
            .meshes = sectionSize(root, "meshes"),
            .nodes = sectionSize(root, "nodes"),
            .samplers = sectionSize(root, "samplers"),
            .scenes = sectionSize(root, "scenes"),
            .skins = sectionSize(root, "skins"),
            .textures = sectionSize(root, "textures")};
}

}  // namespace

bool isSupportedExtension(std::string_view name) {
    return std::find(kSupported.begin(), kSupported.end(), name) != kSupported.end();
}

void checkGltf(GltfDocument& document) {
    // "file: asset" rather than "file.asset": the root's members are named from here.
    GltfElement root(document.root, document.source + ":");
    checkAsset(root);
    checkExtensions(root);
    const GltfCounts counts = countSections(root);
    checkData(root, document);
    checkSurfaces(root, counts, document);
    checkHierarchy(root, counts);
}

}  // namespace edgewise
