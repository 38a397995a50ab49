#include "pipeline/gltf_material.h"

#include "pipeline/gltf_texture.h"

namespace edgewise {
namespace {

template <int N>
glm::vec<N, double> vectorOr(const GltfElement& owner, const char* key, const glm::vec<N, double>& absent) {
    const auto found = owner.find(key);
    if (!found) return absent;
    glm::vec<N, double> value;
    for (int i = 0; i < N; ++i) value[i] = found->at(static_cast<std::size_t>(i)).number();
    return value;
}

AlphaMode alphaMode(const GltfElement& from) {
    const auto mode = from.find("alphaMode");
    if (!mode || mode->string() == "OPAQUE") return AlphaMode::kOpaque;
    return mode->string() == "MASK"    ? AlphaMode::kMask
           : mode->string() == "BLEND" ? AlphaMode::kBlend
                                       : AlphaMode::kOpaque;
}

double emissiveStrength(const GltfElement& from) {
    const auto strength = from.extension("KHR_materials_emissive_strength");
    return strength ? strength->numberOr("emissiveStrength", 1.0) : 1.0;
}

/// All but the textures.
Material readFactors(const GltfElement& from) {
    Material material;
    if (const auto name = from.find("name")) material.name = name->string();
    if (const auto pbr = from.find("pbrMetallicRoughness")) {
        material.base_color = vectorOr<4>(*pbr, "baseColorFactor", glm::dvec4(1.0));
        material.metallic = pbr->numberOr("metallicFactor", 1.0);
        material.roughness = pbr->numberOr("roughnessFactor", 1.0);
    }
    material.emissive = vectorOr<3>(from, "emissiveFactor", glm::dvec3(0.0)) * emissiveStrength(from);
    if (const auto normal = from.find("normalTexture"))
        material.normal_scale = normal->numberOr("scale", 1.0);
    if (const auto occlusion = from.find("occlusionTexture"))
        material.occlusion_strength = occlusion->numberOr("strength", 1.0);
    material.alpha_mode = alphaMode(from);
    material.alpha_cutoff = from.numberOr("alphaCutoff", 0.5);
    material.unlit = from.extension("KHR_materials_unlit").has_value();
    material.double_sided = from.booleanOr("doubleSided", false);
    return material;
}

void readTextures(const GltfElement& from, GltfTextures& textures, Material& material) {
    const auto pbr = from.find("pbrMetallicRoughness");
    if (pbr) material.base_color_map = textures.use(*pbr, "baseColorTexture", ColorEncoding::kSrgb);
    if (material.unlit) return;
    if (pbr)
        material.metallic_roughness_map =
            textures.use(*pbr, "metallicRoughnessTexture", ColorEncoding::kLinear);
    material.normal_map = textures.use(from, "normalTexture", ColorEncoding::kLinear);
    material.occlusion_map = textures.use(from, "occlusionTexture", ColorEncoding::kLinear);
    if (material.emissive != glm::dvec3(0.0))
        material.emissive_map = textures.use(from, "emissiveTexture", ColorEncoding::kSrgb);
}

}  // namespace

void readMaterials(const GltfElement& root, const tinygltf::Model& model, const std::vector<bool>& used,
                   std::uint64_t max_texels, Scene& scene) {
    GltfTextures textures(root, model, max_texels, scene);
    root.each("materials", [&](const GltfElement& from) {
        Material material = readFactors(from);
        if (used[scene.materials.size()]) readTextures(from, textures, material);
        scene.materials.push_back(material);
    });
    Material fallback;
    fallback.name = "default";
    scene.materials.push_back(fallback);
}

}  // namespace edgewise
