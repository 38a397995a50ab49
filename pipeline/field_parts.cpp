#include "pipeline/field_parts.h"

#include <glm/geometric.hpp>
#include <optional>

namespace edgewise {
namespace {

using sdf::Kind, sdf::Node;

/// A half-space, moved or not.
std::optional<HalfSpace> halfSpaceOf(const sdf::Tree& tree, std::uint32_t index) {
    const Node& node = tree.nodes[index];
    const std::vector<double>& n = node.numbers;
    if (node.kind == Kind::kTranslate) {
        auto moved = halfSpaceOf(tree, node.children[0]);
        if (moved) moved->offset += glm::dot(moved->normal_world, glm::dvec3(n[0], n[1], n[2]));
        return moved;
    }
    if (node.kind != Kind::kPlane) return std::nullopt;
    return HalfSpace{glm::normalize(glm::dvec3(n[0], n[1], n[2])), n[3]};
}

void collect(sdf::Tree& tree, std::uint32_t index, std::vector<std::uint32_t>& rest,
             std::vector<HalfSpace>& half_spaces) {
    if (tree.nodes[index].kind == Kind::kUnion) {
        const Node node = tree.nodes[index];
        for (const std::uint32_t child : node.children) {
            if (tree.nodes[child].material == sdf::kNoMaterial) tree.nodes[child].material = node.material;
            collect(tree, child, rest, half_spaces);
        }
        return;
    }
    if (const auto half = halfSpaceOf(tree, index))
        half_spaces.push_back(*half);
    else
        rest.push_back(index);
}

}  // namespace

FieldParts partsOf(const sdf::FieldScene& field) {
    FieldParts parts;
    parts.rest = field;
    sdf::Tree& tree = parts.rest.tree;
    std::vector<std::uint32_t> rest;
    collect(tree, tree.root, rest, parts.half_spaces);
    if (parts.half_spaces.empty()) {
        parts.rest = field;
        return parts;
    }
    if (rest.empty())
        tree = {};
    else
        tree.root = rest.size() == 1 ? rest[0] : tree.add(Kind::kUnion, {}, rest);
    return parts;
}

}  // namespace edgewise
