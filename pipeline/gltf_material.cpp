#include "pipeline/gltf_material.h"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <map>

#include "pipeline/decode_image.h"
#include "pipeline/gltf_ignored.h"

namespace edgewise {
namespace {

Wrap wrapOf(int gltf_wrap) {
    if (gltf_wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::kClampToEdge;
    return gltf_wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::kMirroredRepeat : Wrap::kRepeat;
}

/// Absent filters stay at the defaults of Texture: linear, and linear between levels.
void readSampler(const tinygltf::Sampler& sampler, Texture& texture) {
    texture.wrap_s = wrapOf(sampler.wrapS);
    texture.wrap_t = wrapOf(sampler.wrapT);
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) texture.mag = TexelFilter::kNearest;
    switch (sampler.minFilter) {
        case TINYGLTF_TEXTURE_FILTER_NEAREST:
            texture.min = TexelFilter::kNearest;
            texture.mip.reset();
            break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR:
            texture.mip.reset();
            break;
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
            texture.min = TexelFilter::kNearest;
            texture.mip = TexelFilter::kNearest;
            break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
            texture.mip = TexelFilter::kNearest;
            break;
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
            texture.min = TexelFilter::kNearest;
            break;
        default:
            break;
    }
}

class MaterialReader {
  public:
    MaterialReader(const tinygltf::Model& model, const std::string& source, Scene& scene)
        : model_(model), source_(source), scene_(scene) {}

    Material read(const tinygltf::Material& from, bool used) {
        const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
        Material material;
        material.name = from.name;
        for (int i = 0; i < 4; ++i) material.base_color[i] = pbr.baseColorFactor[static_cast<std::size_t>(i)];
        material.unlit = from.extensions.contains("KHR_materials_unlit");
        material.double_sided = from.doubleSided;
        material.alpha_cutoff = from.alphaCutoff;
        if (from.alphaMode == "MASK") material.alpha_mode = AlphaMode::kMask;
        if (from.alphaMode == "BLEND") material.alpha_mode = AlphaMode::kBlend;
        if (used && pbr.baseColorTexture.index >= 0) readTexture(pbr.baseColorTexture, material);
        return material;
    }

  private:
    void readTexture(const tinygltf::TextureInfo& info, Material& material) {
        const tinygltf::Texture& from = model_.textures[static_cast<std::size_t>(info.index)];
        if (info.texCoord > 1)
            return countIgnored(scene_, "textures with texture coordinates beyond TEXCOORD_1");
        if (from.source < 0) return countIgnored(scene_, "textures without an image of a known format");
        material.base_color_map.uv = info.texCoord;
        material.base_color_map.texture = texture(info.index, from);
    }

    std::uint32_t texture(int index, const tinygltf::Texture& from) {
        const auto [known, is_new] =
            texture_of_.try_emplace(index, static_cast<std::uint32_t>(scene_.textures.size()));
        if (is_new) {
            Texture made;
            made.image = image(from.source);
            if (from.sampler >= 0) readSampler(model_.samplers[static_cast<std::size_t>(from.sampler)], made);
            scene_.textures.push_back(made);
        }
        return known->second;
    }

    std::uint32_t image(int index) {
        const auto [known, is_new] =
            image_of_.try_emplace(index, static_cast<std::uint32_t>(scene_.images.size()));
        if (is_new) {
            const tinygltf::Image& from = model_.images[static_cast<std::size_t>(index)];
            const std::string name = from.uri.empty() ? from.name : from.uri;
            const std::string where =
                fmt::format("{}: images[{}]{}", source_, index, name.empty() ? "" : " " + name);
            scene_.images.push_back(decodeSrgbImage(from.image, where));
            scene_.images.back().name = name;
        }
        return known->second;
    }

    const tinygltf::Model& model_;
    const std::string& source_;
    Scene& scene_;
    std::map<int, std::uint32_t> texture_of_, image_of_;
};

}  // namespace

void readMaterials(const tinygltf::Model& model, const std::vector<bool>& used, const std::string& source,
                   Scene& scene) {
    MaterialReader reader(model, source, scene);
    for (std::size_t i = 0; i < model.materials.size(); ++i)
        scene.materials.push_back(reader.read(model.materials[i], used[i]));
    Material fallback;
    fallback.name = "default";
    scene.materials.push_back(fallback);
}

}  // namespace edgewise
