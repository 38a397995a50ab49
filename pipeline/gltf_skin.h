// Skins of a checked glTF: joint matrices, and vertices moved by them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "pipeline/gltf_element.h"
#include "pipeline/scene.h"

namespace tinygltf {
class Model;
}

namespace edgewise {

/// JOINTS_n and WEIGHTS_n of a primitive: `per_vertex` entries for each vertex.
struct SkinInfluences {
    struct Entry {
        std::uint32_t joint = 0;
        double weight = 0.0;
    };
    std::size_t per_vertex = 0;
    std::vector<Entry> entries;

    bool empty() const { return entries.empty(); }
};

/// For each joint of skins[skin] the map from the mesh's bind space to the world: the joint's world transform
/// times its inverse bind matrix (whose last row is taken as 0, 0, 0, 1). Throws InputError if the matrices
/// are too few, of another format, or the product is not finite.
std::vector<glm::dmat4> jointMatrices(const GltfElement& root, const tinygltf::Model& model, std::size_t skin,
                                      const std::vector<glm::dmat4>& world_of_node,
                                      const std::string& source);

/// Each vertex's weighted sum of joint matrices; weights are divided by their sum, which files round. A
/// vertex whose weights are all 0 follows its first joint. Throws InputError naming `where` for a joint that
/// the skin does not have.
std::vector<glm::dmat4> blendJoints(const SkinInfluences& influences, const std::vector<glm::dmat4>& joints,
                                    const std::string& where);

}  // namespace edgewise
