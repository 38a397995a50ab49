// The textures that a glTF's materials use, and their images, each decoded once for either colour encoding.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "pipeline/decode_image.h"
#include "pipeline/gltf_element.h"
#include "pipeline/scene.h"

namespace tinygltf {
class Model;
}

namespace edgewise {

/// KHR_texture_transform: (u, v, 1) becomes translation * rotation * scale * (u, v, 1). v points down, so
/// that a positive angle, counter-clockwise to the eye, takes (1, 0) towards (0, -1), as the extension's
/// example of the lower left quadrant has it (its code listing has the other sign).
glm::dmat3 textureTransform(const GltfElement& transform);

class GltfTextures {
  public:
    /// `root` is a checked document's; `model` holds its images' encoded bytes. Both outlive this.
    GltfTextures(const GltfElement& root, const tinygltf::Model& model, std::uint64_t max_texels,
                 Scene& scene)
        : root_(root), model_(model), max_texels_(max_texels), scene_(scene) {}

    /// The texture info `key` of a material (or a part of one), if it has one and it can be drawn; what
    /// cannot is counted as ignored. Throws InputError "source: images[i]".
    TextureUse use(const GltfElement& owner, const char* key, ColorEncoding encoding);

  private:
    using Key = std::pair<std::size_t, ColorEncoding>;

    std::uint32_t texture(std::size_t index, std::size_t image_index, ColorEncoding encoding);
    std::uint32_t image(std::size_t index, ColorEncoding encoding);

    GltfElement root_;
    const tinygltf::Model& model_;
    std::uint64_t max_texels_;
    Scene& scene_;
    std::map<Key, std::uint32_t> texture_of_, image_of_;
};

}  // namespace edgewise
