#include "pipeline/gltf_texture.h"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <cmath>

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

/// The image a texture shows: WebP where there is one, never KTX2 (counted among the extensions).
std::optional<std::size_t> imageOf(const GltfElement& texture) {
    if (const auto webp = texture.extension("EXT_texture_webp"))
        if (const auto source = webp->find("source")) return source->integer();
    if (const auto source = texture.find("source")) return source->integer();
    return std::nullopt;
}

/// Bytes of a format that glTF does not know; no bytes at all are another matter: a file that is not there.
bool isForeign(const std::vector<unsigned char>& bytes) {
    return !bytes.empty() && !isKnownPicture(bytes);
}

glm::dvec2 pairOr(const GltfElement& owner, const char* key, const glm::dvec2& absent) {
    const auto found = owner.find(key);
    return found ? glm::dvec2(found->at(0).number(), found->at(1).number()) : absent;
}

}  // namespace

glm::dmat3 textureTransform(const GltfElement& transform) {
    const glm::dvec2 offset = pairOr(transform, "offset", glm::dvec2(0.0));
    const glm::dvec2 scale = pairOr(transform, "scale", glm::dvec2(1.0));
    const double angle = transform.numberOr("rotation", 0.0);
    const double c = std::cos(angle), s = std::sin(angle);
    return {glm::dvec3(c, -s, 0.0) * scale.x, glm::dvec3(s, c, 0.0) * scale.y, glm::dvec3(offset, 1.0)};
}

TextureUse GltfTextures::use(const GltfElement& owner, const char* key, ColorEncoding encoding) {
    const auto info = owner.find(key);
    if (!info) return {};
    TextureUse use;
    std::uint64_t uv = info->integerOr("texCoord", 0);
    if (const auto transform = info->extension("KHR_texture_transform")) {
        uv = transform->integerOr("texCoord", uv);
        use.uv_from_vertex = textureTransform(*transform);
    }
    const auto index = static_cast<std::size_t>(info->need("index").integer());
    const auto source = imageOf(root_.need("textures").at(index));
    if (uv > 1)
        countIgnored(scene_, "textures with texture coordinates beyond TEXCOORD_1");
    else if (!source || isForeign(model_.images[*source].image))
        countIgnored(scene_, "textures without an image of a known format");
    else
        use.texture = texture(index, *source, encoding);
    use.uv = use.present() ? static_cast<int>(uv) : 0;
    return use;
}

std::uint32_t GltfTextures::texture(std::size_t index, std::size_t image_index, ColorEncoding encoding) {
    const auto [known, is_new] =
        texture_of_.try_emplace({index, encoding}, static_cast<std::uint32_t>(scene_.textures.size()));
    if (is_new) {
        Texture made;
        made.image = image(image_index, encoding);
        const int sampler = model_.textures[index].sampler;
        if (sampler >= 0) readSampler(model_.samplers[static_cast<std::size_t>(sampler)], made);
        scene_.textures.push_back(made);
    }
    return known->second;
}

std::uint32_t GltfTextures::image(std::size_t index, ColorEncoding encoding) {
    const auto [known, is_new] =
        image_of_.try_emplace({index, encoding}, static_cast<std::uint32_t>(scene_.images.size()));
    if (is_new) {
        const tinygltf::Image& from = model_.images[index];
        const std::string name = from.uri.empty() ? from.name : from.uri;
        const std::string where =
            fmt::format("{}: images[{}]{}", scene_.source, index, name.empty() ? "" : " " + name);
        scene_.images.push_back(decodeImage(from.image, encoding, max_texels_, where));
        scene_.images.back().name = name;
    }
    return known->second;
}

}  // namespace edgewise
