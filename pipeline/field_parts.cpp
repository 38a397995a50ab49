#include "pipeline/field_parts.h"

#include <glm/geometric.hpp>
#include <optional>

#include "sdf/scale_bounds.h"

namespace edgewise {
namespace {

using sdf::Kind, sdf::Node;

/// The rows are the inverse's: the rotation's columns.
glm::dvec3 turned(const sdf::RotationRows& rows, const glm::dvec3& v) {
    glm::dvec3 sum(0.0);
    for (int j = 0; j < 3; ++j) sum += v[j] * glm::dvec3(rows[3 * j], rows[3 * j + 1], rows[3 * j + 2]);
    return sum;
}

/// A half-space, moved, turned and scaled or not.
std::optional<HalfSpace> halfSpaceOf(const sdf::Tree& tree, std::uint32_t index) {
    const Node& node = tree.nodes[index];
    const std::vector<double>& n = node.numbers;
    if (node.kind == Kind::kTranslate || node.kind == Kind::kRotate || node.kind == Kind::kScale) {
        auto moved = halfSpaceOf(tree, node.children[0]);
        if (!moved) return moved;
        if (node.kind == Kind::kTranslate)
            moved->offset += glm::dot(moved->normal_world, glm::dvec3(n[0], n[1], n[2]));
        if (node.kind == Kind::kScale) moved->offset *= n[0];
        if (node.kind == Kind::kRotate)
            moved->normal_world = turned(sdf::rotationRows(n), moved->normal_world);
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
