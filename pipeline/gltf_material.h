// Materials, textures and images of a checked glTF.
#pragma once

#include <string>
#include <vector>

#include "pipeline/scene.h"

namespace tinygltf {
class Model;
}

namespace edgewise {

/// Fills scene.materials with the file's materials in order, then glTF's default material, and scene.textures
/// and scene.images with what the materials marked in `used` need, each once. Images of the others are not
/// decoded, so they cannot fail. Throws InputError "source: images[i]".
void readMaterials(const tinygltf::Model& model, const std::vector<bool>& used, const std::string& source,
                   Scene& scene);

}  // namespace edgewise
