// Nodes, scenes, cameras: the nodes form a forest.
#include <cmath>
#include <vector>

#include "pipeline/gltf_animation.h"
#include "pipeline/gltf_check.h"
#include "pipeline/gltf_instancing.h"
#include "pipeline/gltf_lights.h"

namespace edgewise {
namespace {

constexpr std::size_t kNoParent = std::numeric_limits<std::size_t>::max();

void checkTransform(const GltfElement& node) {
    const auto matrix = node.find("matrix");
    if (matrix) {
        matrix->numbers(16);
        for (const char* key : {"translation", "rotation", "scale"})
            if (node.has(key)) node.fail(fmt::format("has both a matrix and a {}", key));
        for (const std::size_t i : {3u, 7u, 11u, 15u})
            if (const double value = matrix->at(i).number(); value != (i == 15 ? 1.0 : 0.0))
                matrix->at(i).fail(fmt::format("{}: the last row is not 0, 0, 0, 1", value));
    }
    if (const auto translation = node.find("translation")) translation->numbers(3);
    if (const auto scale = node.find("scale")) scale->numbers(3);
    if (const auto rotation = node.find("rotation")) {
        rotation->numbers(4);
        double largest = 0.0;
        for (std::size_t i = 0; i < 4; ++i) largest = std::max(largest, std::abs(rotation->at(i).number()));
        if (largest == 0.0) rotation->fail("is the quaternion 0, 0, 0, 0");
    }
}

void checkNode(const GltfElement& node, const GltfCounts& counts) {
    node.referenceIf("mesh", counts.meshes, "meshes");
    node.referenceIf("camera", counts.cameras, "cameras");
    node.referenceIf("skin", counts.skins, "skins");
    if (const auto weights = node.find("weights")) node.moderatesIf("weights", weights->array().size());
    checkTransform(node);
    checkInstancing(node, counts);
}

std::vector<std::size_t> checkParents(const GltfElement& root, const GltfCounts& counts) {
    std::vector<std::size_t> parent(counts.nodes, kNoParent);
    std::size_t index = 0;
    root.each("nodes", [&](const GltfElement& node) {
        node.each("children", [&](const GltfElement& child) {
            const std::size_t name = child.reference(counts.nodes, "nodes");
            if (parent[name] != kNoParent)
                child.fail(fmt::format("nodes[{}] already has the parent nodes[{}]", name, parent[name]));
            parent[name] = index;
        });
        ++index;
    });
    return parent;
}

/// Climbs from every node until a root or a climbed node; meeting the own climb again is a cycle.
void checkCycles(const GltfElement& root, const std::vector<std::size_t>& parent) {
    std::vector<std::size_t> climb_of(parent.size(), kNoParent);
    for (std::size_t start = 0; start < parent.size(); ++start) {
        std::size_t node = start;
        for (; node != kNoParent && climb_of[node] == kNoParent; node = parent[node]) climb_of[node] = start;
        if (node != kNoParent && climb_of[node] == start)
            root.need("nodes").at(node).fail("is its own ancestor");
    }
}

/// Real exporters list nodes that have a parent outside the scene; only the same node twice is refused here.
void checkScene(const GltfElement& scene, const GltfCounts& counts) {
    std::vector<bool> listed(counts.nodes, false);
    scene.each("nodes", [&](const GltfElement& node) {
        const std::size_t index = node.reference(counts.nodes, "nodes");
        if (listed[index]) node.fail(fmt::format("nodes[{}] is listed twice", index));
        listed[index] = true;
    });
}

void needNumbers(const GltfElement& object, std::initializer_list<const char*> keys) {
    for (const char* key : keys) object.need(key).number();
}

void needPositive(const GltfElement& object, const char* key) {
    const auto found = object.find(key);
    if (found && !(found->number() > 0.0)) found->fail(fmt::format("{} is not above 0", found->number()));
}

void checkCamera(const GltfElement& camera) {
    const std::string type = camera.need("type").string();
    if (!isKnownCamera(camera)) return;
    const GltfElement lens = camera.need(type.c_str()).object();
    if (type == "orthographic") return needNumbers(lens, {"xmag", "ymag", "znear", "zfar"});
    needNumbers(lens, {"yfov", "znear"});
    needPositive(lens, "aspectRatio");
    needPositive(lens, "zfar");
}

void checkSkin(const GltfElement& skin, const GltfCounts& counts) {
    skin.need("joints").array();
    skin.each("joints", [&](const GltfElement& joint) { joint.reference(counts.nodes, "nodes"); });
    skin.referenceIf("skeleton", counts.nodes, "nodes");
    skin.referenceIf("inverseBindMatrices", counts.accessors, "accessors");
}

}  // namespace

bool isKnownCamera(const GltfElement& camera) {
    const std::string type = camera.need("type").string();
    return type == "perspective" || type == "orthographic";
}

void checkHierarchy(const GltfElement& root, const GltfCounts& counts) {
    root.each("nodes", [&](const GltfElement& node) { checkNode(node, counts); });
    checkCycles(root, checkParents(root, counts));
    root.each("cameras", checkCamera);
    root.each("skins", [&](const GltfElement& skin) { checkSkin(skin, counts); });
    checkLights(root);
    root.each("animations", [&](const GltfElement& animation) { checkAnimation(animation, counts); });
    root.each("scenes", [&](const GltfElement& scene) { checkScene(scene, counts); });
    root.referenceIf("scene", counts.scenes, "scenes");
}

}  // namespace edgewise
