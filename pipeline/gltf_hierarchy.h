// The nodes of a checked glTF's scene, in the order they are drawn, and where they are.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace edgewise {

struct PlacedNode {
    int node = 0;
    glm::dmat4 world_from_node{1.0};
};

/// Depth-first from the scene's nodes, children in the file's order; iterative, since hierarchies may be
/// 100,000 deep. `wanted` is --scene: a name or an index, empty for the file's own scene, else its first,
/// else every root. A scene's nodes are its roots, even one that has a parent outside the scene (whose
/// transform then does not count). Throws InputError for a node that is listed below another listed one, and
/// for a transform that is not finite.
std::vector<PlacedNode> depthFirstNodes(const tinygltf::Model& model, const std::string& wanted,
                                        const std::string& source);

/// The world transform of every node of the file by its index: as `placed`, and below the file's own roots
/// for what the scene leaves out.
std::vector<glm::dmat4> worldOfEveryNode(const tinygltf::Model& model, const std::vector<PlacedNode>& placed);

}  // namespace edgewise
