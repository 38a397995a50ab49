#include "sdf/field_of_all.h"

#include <glm/geometric.hpp>

namespace edgewise::sdf {
namespace {

std::uint32_t addShape(Tree& tree, const AnalyticShape& shape, const glm::dvec3& eye_world) {
    const glm::dvec3& c = shape.center_world;
    if (shape.type == AnalyticShape::Type::kSphere) {
        std::uint32_t ball = tree.add(Kind::kSphere, {shape.radius}, {}, shape.material);
        if (glm::distance(eye_world, c) < shape.radius) {  // seen from within: what is solid lies around it
            const std::uint32_t around = tree.add(Kind::kSphere, {2.0 * shape.radius}, {}, shape.material);
            ball = tree.add(Kind::kDifference, {}, {around, ball});
        }
        return tree.add(Kind::kTranslate, {c.x, c.y, c.z}, {ball});
    }
    const double side = glm::dot(eye_world, shape.normal_world) < shape.offset ? -1.0 : 1.0;
    const glm::dvec3 n = side * shape.normal_world;
    return tree.add(Kind::kPlane, {n.x, n.y, n.z, side * shape.offset}, {}, shape.material);
}

}  // namespace

FieldScene fieldOfAll(FieldScene scene, const glm::dvec3& eye_world) {
    scene.convex.reset();
    if (scene.analytic.empty()) return scene;
    std::vector<std::uint32_t> parts;
    if (!scene.tree.empty()) parts.push_back(scene.tree.root);
    for (const AnalyticShape& shape : scene.analytic) parts.push_back(addShape(scene.tree, shape, eye_world));
    scene.tree.root = scene.tree.add(Kind::kUnion, {}, parts);
    scene.analytic.clear();
    return scene;
}

}  // namespace edgewise::sdf
