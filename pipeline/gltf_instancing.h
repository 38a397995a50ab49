// EXT_mesh_gpu_instancing: many copies of a node's mesh.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "pipeline/gltf_element.h"

namespace tinygltf {
class Model;
}

namespace edgewise {

struct GltfCounts;

/// Checks a node's instancing, if it has any: a part of checkGltf.
void checkInstancing(const GltfElement& node, const GltfCounts& counts);

/// How many copies of its mesh nodes[node] asks for, by the count of its first attribute.
std::size_t instanceTotal(const GltfElement& root, std::size_t node);

/// For each instance of nodes[node], in order, its translation * rotation * scale; one identity for a node
/// without instancing. Throws InputError naming the node: formats, differing counts, a rotation of zero.
std::vector<glm::dmat4> instanceTransforms(const GltfElement& root, const tinygltf::Model& model,
                                           std::size_t node, const std::string& source);

}  // namespace edgewise
