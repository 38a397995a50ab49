#include "sdf/scale_bounds.h"

#include <algorithm>
#include <cmath>

#include "sdf/scene_error.h"

namespace edgewise::sdf {
namespace {

constexpr double kRadians = 0.017453292519943295769;

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
    if (twist.numbers[1] > 0.0) return twist.numbers[1];
    const Box box = levelBox(tree, twist.children[0]);
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

}  // namespace edgewise::sdf
