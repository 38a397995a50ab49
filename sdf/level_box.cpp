// Boxes around level sets, from the leaves up. Smooth unions lower the nearest value by less than their
// smoothness, over any number of children: each fold lowers by (k - d)^2 / (4k) where d is what the folds
// before it took, until d reaches k.
#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <map>

#include "sdf/scale_bounds.h"
#include "sdf/tree.h"

namespace edgewise::sdf {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Box kEverything{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
constexpr Box kNothing{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

Box around(double x, double y, double z) {
    return {{-x, -y, -z}, {x, y, z}};
}
Box cube(double half) {
    return around(half, half, half);
}

Box hull(Box a, const Box& b) {
    if (b.empty()) return a;
    for (int i = 0; i < 3; ++i)
        a.low[i] = std::min(a.low[i], b.low[i]), a.high[i] = std::max(a.high[i], b.high[i]);
    return a;
}
Box common(Box a, const Box& b) {
    for (int i = 0; i < 3; ++i)
        a.low[i] = std::max(a.low[i], b.low[i]), a.high[i] = std::min(a.high[i], b.high[i]);
    return a;
}
Box grown(Box box, double x, double y, double z) {
    const double by[3] = {x, y, z};
    for (int i = 0; i < 3; ++i) box.low[i] -= by[i], box.high[i] += by[i];
    return box;
}

Box capsuleBox(const std::vector<double>& n, double level) {
    Box box;
    for (int i = 0; i < 3; ++i) {
        box.low[i] = std::min(n[i], n[3 + i]) - n[6] - level;
        box.high[i] = std::max(n[i], n[3 + i]) + n[6] + level;
    }
    return box;
}

/// Half a space has a box only where it is cut along an axis.
Box planeBox(const std::vector<double>& n, double level) {
    const double size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    Box box = kEverything;
    for (int i = 0; i < 3; ++i) {
        if (n[i] == size) box.high[i] = n[3] + level;
        if (n[i] == -size) box.low[i] = -n[3] - level;
    }
    return box;
}

Box rotated(const Box& box, const RotationRows& rows) {
    if (box.empty()) return box;
    if (!box.bounded()) return kEverything;
    Box result;
    for (int i = 0; i < 3; ++i) {
        // The inverse's rows are the columns of the rotation.
        result.low[i] = result.high[i] = 0.0;
        for (int j = 0; j < 3; ++j) {
            const double a = rows[3 * j + i] * box.low[j], b = rows[3 * j + i] * box.high[j];
            result.low[i] += std::min(a, b), result.high[i] += std::max(a, b);
        }
    }
    return result;
}

Box mirrored(Box box, const std::vector<double>& axes) {
    for (int i = 0; i < 3; ++i)
        if (axes[i] != 0.0) box.low[i] = -box.high[i];
    return box;
}

Box repeated(Box box, const std::vector<double>& n) {
    for (int i = 0; i < 3; ++i)
        if (n[i] > 0.0 && n[3 + i] > 0.0) box.low[i] -= n[i] * n[3 + i], box.high[i] += n[i] * n[3 + i];
    return box;
}

Box twisted(const Box& box, double radius, double level) {
    Box result = around(radius + level, 0.0, radius + level);
    result.low[1] = box.low[1], result.high[1] = box.high[1];
    return result;
}

/// Of one tree. A node's box at level 0 is made once: repetitions and twists ask for their child's besides
/// the one at their own level, which would double the work with every one inside another.
class LevelBoxes {
  public:
    explicit LevelBoxes(const Tree& tree) : tree_(tree) {}

    Box of(std::uint32_t index, double level) {
        if (level != 0.0) return make(index, level);
        const auto known = solid_.find(index);
        return known != solid_.end() ? known->second : solid_[index] = make(index, 0.0);
    }

  private:
    Box make(std::uint32_t index, double level);

    const Tree& tree_;
    std::map<std::uint32_t, Box> solid_;
};

}  // namespace

bool Box::bounded() const {
    return std::all_of(low, low + 3, [](double x) { return std::isfinite(x); }) &&
           std::all_of(high, high + 3, [](double x) { return std::isfinite(x); });
}
bool Box::empty() const {
    return low[0] > high[0] || low[1] > high[1] || low[2] > high[2];
}

Box LevelBoxes::make(std::uint32_t index, double level) {
    const Node& node = tree_.nodes[index];
    const std::vector<double>& n = node.numbers;
    const auto child = [&](double at) { return of(node.children[0], at); };
    const auto all = [&](double at, auto combine, Box box) {
        for (const std::uint32_t c : node.children) box = combine(box, of(c, at));
        return box;
    };
    constexpr double kToCorner =
        1.2584085723648188;  // of the dodecahedron and icosahedron, over the inradius
    switch (node.kind) {
        case Kind::kSphere:
            return cube(n[0] + level);
        case Kind::kBox:
        case Kind::kBoxFrame:
            return grown(around(n[0] / 2, n[1] / 2, n[2] / 2), level, level, level);
        case Kind::kTorus:
            return around(n[0] + n[1] + level, n[1] + level, n[0] + n[1] + level);
        case Kind::kCapsule:
            return capsuleBox(n, level);
        case Kind::kCylinder:
            return around(n[0] + level, n[1] / 2 + level, n[0] + level);
        case Kind::kCone: {
            const double r = std::max(n[0], n[1]) + level;
            return around(r, n[2] / 2 + level, r);
        }
        case Kind::kPlane:
            return planeBox(n, level);
        case Kind::kEllipsoid: {
            const double s = 1.0 + level / std::min({n[0], n[1], n[2]});
            return around(n[0] * s, n[1] * s, n[2] * s);
        }
        case Kind::kOctahedron:
            return cube(n[0] + std::sqrt(3.0) * level);
        case Kind::kDodecahedron:
        case Kind::kIcosahedron:
            return cube(kToCorner * (n[0] + level));
        case Kind::kHexPrism: {
            const double r = (n[0] + level) * 2.0 / std::sqrt(3.0);
            return around(r, n[1] / 2 + level, r);
        }
        case Kind::kGyroid:
            return kEverything;
        case Kind::kMenger:
            return cube(n[0] / 2 + level);

        case Kind::kUnion:
            return all(level, hull, kNothing);
        case Kind::kSmoothUnion:
            return all(level + n[0], hull, kNothing);
        case Kind::kIntersection:
        case Kind::kSmoothIntersection:
            return all(level, common, kEverything);
        case Kind::kDifference:
        case Kind::kSmoothDifference:
            return child(level);

        case Kind::kComplement:
            return kEverything;
        case Kind::kOffset:
            return child(level + n[0]);
        case Kind::kShell:
            return child(level + n[0] / 2);
        case Kind::kScaleValue:
            return child(level / n[0]);
        case Kind::kDisplace:
            return child(level * displacementBound(n) + std::abs(n[0]));
        case Kind::kTranslate: {
            Box box = child(level);
            for (int i = 0; i < 3; ++i) box.low[i] += n[i], box.high[i] += n[i];
            return box;
        }
        case Kind::kRotate:
            return rotated(child(level), rotationRows(n));
        case Kind::kScale: {
            Box box = child(level / n[0]);
            for (int i = 0; i < 3; ++i) box.low[i] *= n[0], box.high[i] *= n[0];
            return box;
        }
        case Kind::kStretch: {
            Box box = child(level / std::min({n[0], n[1], n[2]}));
            for (int i = 0; i < 3; ++i) box.low[i] *= n[i], box.high[i] *= n[i];
            return box;
        }
        case Kind::kMirror:
            return mirrored(child(level), n);
        case Kind::kRepeat: {
            const Repetition cells = repetitionOf(tree_, node, child(0.0));
            // Along a wall values are no more than its distance and the margin, however far away the child.
            return cells.walls && level > cells.least_margin ? kEverything : repeated(child(level), n);
        }
        case Kind::kElongate:
            return grown(child(level), n[0] / 2, n[1] / 2, n[2] / 2);
        case Kind::kTwist: {
            const double radius = twistRadius(node, child(0.0));
            return twisted(child(level * twistBound(n[0], radius)), radius, level);
        }
    }
    return kEverything;
}

Box levelBox(const Tree& tree, std::uint32_t index, double level) {
    return LevelBoxes(tree).of(index, level);
}

}  // namespace edgewise::sdf
