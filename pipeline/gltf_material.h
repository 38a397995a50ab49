// Materials of a checked glTF.
#pragma once

#include <vector>

#include "pipeline/gltf_element.h"
#include "pipeline/scene.h"

namespace tinygltf {
class Model;
}

namespace edgewise {

/// Fills scene.materials with the file's materials in order, then glTF's default material, and scene.textures
/// and scene.images with what the materials marked in `used` need. Images that no used material shows are not
/// decoded, so they cannot fail; one of more than max_texels is a FailureError; an unlit material shows its
/// base colour alone. Throws InputError "source: images[i]".
void readMaterials(const GltfElement& root, const tinygltf::Model& model, const std::vector<bool>& used,
                   std::uint64_t max_texels, Scene& scene);

}  // namespace edgewise
