#include "sdf/scale_bounds.h"

#include <algorithm>
#include <cmath>

#include "sdf/scene_error.h"

namespace edgewise::sdf {
namespace {

constexpr double kRadians = 0.017453292519943295769;

/// Whether the node's solid and values are their own mirror images across the origin along an axis.
bool isEven(const Tree& tree, std::uint32_t index, int axis) {
    const Node& node = tree.nodes[index];
    switch (node.kind) {
        case Kind::kCapsule:
            return node.numbers[axis] == -node.numbers[3 + axis] && [&] {
                for (int i = 0; i < 3; ++i)
                    if (i != axis && node.numbers[i] != node.numbers[3 + i] && node.numbers[axis] != 0.0)
                        return false;
                return true;
            }();
        case Kind::kPlane:
            return node.numbers[axis] == 0.0;
        case Kind::kCone:
            return axis != 1 || node.numbers[0] == node.numbers[1];
        case Kind::kGyroid:
        case Kind::kRotate:
        case Kind::kTwist:
        case Kind::kDisplace:
            return false;
        case Kind::kTranslate:
            if (node.numbers[axis] != 0.0) return false;
            break;
        case Kind::kMirror:
            if (node.numbers[axis] != 0.0) return true;
            break;
        default:
            break;
    }
    return std::all_of(node.children.begin(), node.children.end(),
                       [&](std::uint32_t child) { return isEven(tree, child, axis); });
}

}  // namespace

RotationRows rotationRows(const std::vector<double>& n) {
    const double size = std::hypot(n[0], n[1], n[2]);
    const double x = n[0] / size, y = n[1] / size, z = n[2] / size;
    const double c = std::cos(-n[3] * kRadians), s = std::sin(-n[3] * kRadians), d = 1.0 - c;
    return {c + x * x * d,     x * y * d - z * s, x * z * d + y * s, y * x * d + z * s, c + y * y * d,
            y * z * d - x * s, z * x * d - y * s, z * y * d + x * s, c + z * z * d};
}

double twistBound(double degrees_per_unit, double radius) {
    const double shear = std::abs(degrees_per_unit * kRadians) * radius;
    return 0.5 * (shear + std::sqrt(shear * shear + 4.0));
}

double twistRadius(const Tree& tree, const Node& twist) {
    return twistRadius(twist, levelBox(tree, twist.children[0]));
}

double twistRadius(const Node& twist, const Box& box) {
    if (twist.numbers[1] > 0.0) return twist.numbers[1];
    const double x = std::max(std::abs(box.low[0]), std::abs(box.high[0]));
    const double z = std::max(std::abs(box.low[2]), std::abs(box.high[2]));
    const double radius = std::hypot(x, z);
    if (!std::isfinite(radius) || box.empty())
        throw SceneError(twist.path + ".radius", "must be given: the child has no bounds across the y axis");
    return radius;
}

double displacementBound(const std::vector<double>& n) {
    return 1.0 + std::abs(n[0]) * std::max({std::abs(n[1]), std::abs(n[2]), std::abs(n[3])});
}

Repetition repetitionOf(const Tree& tree, const Node& node) {
    return repetitionOf(tree, node, levelBox(tree, node.children[0]));
}

Repetition repetitionOf(const Tree& tree, const Node& node, const Box& child) {
    Repetition cells;
    cells.box = child;
    for (int i = 0; i < 3; ++i) {
        const bool repeats = node.numbers[i] > 0.0 && node.numbers[3 + i] > 0.0;
        cells.spacing[i] = repeats ? node.numbers[i] : 1.0,
        cells.count[i] = repeats ? node.numbers[3 + i] : 0.0;
        if (!repeats || cells.box.empty()) continue;
        cells.margin[i] =
            0.5 * cells.spacing[i] - std::max(std::abs(cells.box.low[i]), std::abs(cells.box.high[i]));
        if (!(cells.margin[i] >= 0.0))
            throw SceneError(node.path, "repeats a child that reaches beyond half the spacing");
        cells.walls = cells.walls || !isEven(tree, node.children[0], i);
        cells.least_margin = std::min(cells.least_margin, cells.margin[i]);
    }
    return cells;
}

}  // namespace edgewise::sdf
