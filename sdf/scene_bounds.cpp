#include <algorithm>
#include <cmath>

#include "sdf/load_sdf.h"

namespace edgewise::sdf {
namespace {

/// Copies to either side that stand for no end of them, and how many of those a camera frames.
constexpr double kEndless = 1e6, kShown = 3.0;

/// Leaves out of every union the children that no box holds.
void keepBounded(Tree& tree, std::uint32_t index) {
    for (const std::uint32_t child : tree.nodes[index].children) keepBounded(tree, child);
    Node& node = tree.nodes[index];
    if (node.kind == Kind::kRepeat)
        for (std::size_t axis = 3; axis < 6; ++axis)
            if (node.numbers[axis] >= kEndless) node.numbers[axis] = kShown;
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

double farFor(const Box& bounds) {
    constexpr double kDiagonals = 8.0;
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) sum += (bounds.high[i] - bounds.low[i]) * (bounds.high[i] - bounds.low[i]);
    return kDiagonals * std::sqrt(sum);
}

}  // namespace edgewise::sdf
