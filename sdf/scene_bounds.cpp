#include <algorithm>

#include "sdf/load_sdf.h"

namespace edgewise::sdf {
namespace {

/// Leaves out of every union the children that no box holds.
void keepBounded(Tree& tree, std::uint32_t index) {
    for (const std::uint32_t child : tree.nodes[index].children) keepBounded(tree, child);
    Node& node = tree.nodes[index];
    if (node.kind != Kind::kUnion && node.kind != Kind::kSmoothUnion) return;
    std::erase_if(node.children, [&](std::uint32_t child) {
        const Box box = levelBox(tree, child);
        return !box.bounded() && !box.empty();
    });
}

Box hull(Box a, const Box& b) {
    if (a.empty()) return b;
    for (int i = 0; i < 3; ++i)
        a.low[i] = std::min(a.low[i], b.low[i]), a.high[i] = std::max(a.high[i], b.high[i]);
    return a;
}

}  // namespace

Box sceneBounds(const FieldScene& scene) {
    constexpr Box kNothing{{1, 1, 1}, {-1, -1, -1}};
    Box bounds = kNothing;
    if (!scene.tree.empty()) {
        Tree bounded = scene.tree;
        keepBounded(bounded, bounded.root);
        const Box box = levelBox(bounded, bounded.root);
        if (box.bounded() && !box.empty()) bounds = box;
    }
    for (const AnalyticShape& shape : scene.analytic) {
        if (shape.type != AnalyticShape::Type::kSphere) continue;
        Box sphere;
        for (int i = 0; i < 3; ++i)
            sphere.low[i] = shape.center_world[i] - shape.radius,
            sphere.high[i] = shape.center_world[i] + shape.radius;
        bounds = hull(bounds, sphere);
    }
    return bounds.empty() ? Box{{0, 0, 0}, {0, 0, 0}} : bounds;
}

}  // namespace edgewise::sdf
