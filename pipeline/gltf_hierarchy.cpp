#include "pipeline/gltf_hierarchy.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include "pipeline/error.h"
#include "pipeline/gltf_choice.h"
#include "pipeline/gltf_transform.h"

namespace edgewise {
namespace {

std::size_t chosenScene(const tinygltf::Model& model, const std::string& wanted, const std::string& source) {
    if (wanted.empty()) return model.defaultScene >= 0 ? static_cast<std::size_t>(model.defaultScene) : 0;
    std::vector<std::string> names;
    for (const tinygltf::Scene& scene : model.scenes) names.push_back(scene.name);
    return chooseElement(names, wanted, "--scene", source, "scenes");
}

std::vector<int> fileRoots(const tinygltf::Model& model) {
    std::vector<bool> has_parent(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children) has_parent[static_cast<std::size_t>(child)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        if (!has_parent[i]) roots.push_back(static_cast<int>(i));
    return roots;
}

std::vector<int> sceneRoots(const tinygltf::Model& model, const std::string& wanted,
                            const std::string& source) {
    if (model.scenes.empty() && wanted.empty()) return fileRoots(model);
    return model.scenes[chosenScene(model, wanted, source)].nodes;
}

/// Calls visit(node, world) for the roots and what is below them; visit says whether to go on below.
template <class Visit>
void traverse(const tinygltf::Model& model, const std::vector<int>& roots, const Visit& visit) {
    std::vector<PlacedNode> pending;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
        pending.push_back({*root, glm::dmat4(1.0)});
    while (!pending.empty()) {
        PlacedNode current = pending.back();
        pending.pop_back();
        const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(current.node)];
        current.world_from_node = current.world_from_node * localTransform(node);
        if (!visit(current)) continue;
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            pending.push_back({*child, current.world_from_node});
    }
}

}  // namespace

std::vector<PlacedNode> depthFirstNodes(const tinygltf::Model& model, const std::string& wanted,
                                        const std::string& source) {
    std::vector<PlacedNode> placed;
    std::vector<bool> visited(model.nodes.size(), false);
    traverse(model, sceneRoots(model, wanted, source), [&](const PlacedNode& node) {
        const std::string where = fmt::format("{}: nodes[{}]", source, node.node);
        if (visited[static_cast<std::size_t>(node.node)])
            throw InputError(where, "the scene lists it and one of its ancestors");
        visited[static_cast<std::size_t>(node.node)] = true;
        if (!isFinite(node.world_from_node)) throw InputError(where, "its world transform is not finite");
        placed.push_back(node);
        return true;
    });
    return placed;
}

std::vector<glm::dmat4> worldOfEveryNode(const tinygltf::Model& model,
                                         const std::vector<PlacedNode>& placed) {
    std::vector<glm::dmat4> world(model.nodes.size());
    std::vector<bool> known(model.nodes.size(), false);
    for (const PlacedNode& node : placed) {
        world[static_cast<std::size_t>(node.node)] = node.world_from_node;
        known[static_cast<std::size_t>(node.node)] = true;
    }
    // What is below a known node is known too.
    traverse(model, fileRoots(model), [&](const PlacedNode& node) {
        const auto i = static_cast<std::size_t>(node.node);
        if (!known[i]) world[i] = node.world_from_node;
        return !known[i];
    });
    return world;
}

}  // namespace edgewise
