// From a tree to instructions, with Lipschitz bounds.
#include <algorithm>
#include <cmath>

#include "sdf/scale_bounds.h"
#include "sdf/scene_error.h"
#include "sdf/tree.h"

namespace edgewise::sdf {
namespace {

constexpr double kRadians = 0.017453292519943295769;

/// A node is asked at a position slot, whose Lipschitz bound is `slope`; its value goes to a value slot.
struct Place {
    int position = 0;
    double slope = 1.0;
    int value = 0;
    std::uint32_t material = kNoMaterial;
};

class Lowering {
  public:
    explicit Lowering(const Tree& tree) : tree_(tree) {}

    Tape run() {
        tape_.lipschitz = emit(tree_.root, {});
        return std::move(tape_);
    }

  private:
    using Numbers = std::vector<double>;

    Instruction& add(Code code, const Numbers& numbers, double lipschitz) {
        Instruction i;
        i.code = code;
        i.numbers = static_cast<std::uint32_t>(tape_.numbers.size());
        i.node = node_;
        i.lipschitz = lipschitz;
        tape_.numbers.insert(tape_.numbers.end(), numbers.begin(), numbers.end());
        tape_.instructions.push_back(i);
        return tape_.instructions.back();
    }

    double shape(Code code, const Place& at, const Numbers& numbers) {
        Instruction& i = add(code, numbers, at.slope);
        i.to = static_cast<std::uint8_t>(at.value), i.a = static_cast<std::uint8_t>(at.position);
        i.material = at.material;
        return at.slope;
    }
    double value(Code code, const Place& at, const Numbers& numbers, double lipschitz) {
        Instruction& i = add(code, numbers, lipschitz);
        i.to = static_cast<std::uint8_t>(at.value), i.b = static_cast<std::uint8_t>(at.position);
        return lipschitz;
    }
    double pair(Code code, const Place& at, const Numbers& numbers, double lipschitz) {
        Instruction& i = add(code, numbers, lipschitz);
        i.to = static_cast<std::uint8_t>(at.value), i.b = static_cast<std::uint8_t>(at.value + 1);
        return lipschitz;
    }
    /// The place of a child behind a change of position that multiplies distances by at most `factor`.
    Place move(Code code, const Place& at, const Numbers& numbers, double factor = 1.0) {
        Place inner = at;
        inner.position = at.position + 1;
        inner.slope = at.slope * factor;
        requireSlot(inner.position);
        Instruction& i = add(code, numbers, inner.slope);
        i.to = static_cast<std::uint8_t>(inner.position), i.a = static_cast<std::uint8_t>(at.position);
        tape_.positions = std::max(tape_.positions, inner.position + 1);
        return inner;
    }

    void requireSlot(int slot) const {
        if (slot >= kMostSlots)
            throw SceneError(tree_.nodes[node_].path,
                             "lies too deep: operators and changes of position nest at most " +
                                 std::to_string(kMostSlots - 1) + " deep");
    }

    double emit(std::uint32_t index, Place at) {
        const Node& node = tree_.nodes[index];
        node_ = index;
        requireSlot(at.value);
        tape_.values = std::max(tape_.values, at.value + 1);
        if (node.material != kNoMaterial) at.material = node.material;
        const double lipschitz = emitKind(node, at);
        if (!node.declared_lipschitz) return lipschitz;
        tape_.instructions.back().lipschitz = *node.declared_lipschitz * at.slope;
        return tape_.instructions.back().lipschitz;
    }
    double child(const Node& node, const Place& at) {
        const std::uint32_t own = node_;
        const double lipschitz = emit(node.children[0], at);
        node_ = own;
        return lipschitz;
    }

    double fold(Code code, const Node& node, const Place& at, const Numbers& numbers) {
        const std::uint32_t own = node_;
        double lipschitz = emit(node.children[0], at);
        for (std::size_t c = 1; c < node.children.size(); ++c) {
            Place next = at;
            ++next.value;
            lipschitz = std::max(lipschitz, emit(node.children[c], next));
            node_ = own;
            pair(code, at, numbers, lipschitz);
        }
        node_ = own;
        return lipschitz;
    }

    double menger(const Node& node, const Place& at) {
        const double size = node.numbers[0], half = 0.5 * size;
        double lipschitz = shape(Code::boxAt, at, {half, half, half});
        Place next = at;
        ++next.value;
        requireSlot(next.value);
        tape_.values = std::max(tape_.values, next.value + 1);
        double cell = size;
        for (int level = 0; level < static_cast<int>(node.numbers[1]); ++level, cell /= 3.0) {
            shape(Code::tunnelsAt, next, {-half, -half, -half, cell});
            lipschitz = pair(Code::subtract, at, {}, at.slope);
        }
        return lipschitz;
    }

    double capsule(const Node& node, const Place& at) {
        const Numbers& n = node.numbers;
        const double x = n[3] - n[0], y = n[4] - n[1], z = n[5] - n[2], length2 = x * x + y * y + z * z;
        return shape(Code::capsuleAt, at,
                     {n[0], n[1], n[2], x, y, z, length2 > 0.0 ? 1.0 / length2 : 0.0, n[6]});
    }

    double plane(const Node& node, const Place& at) {
        const Numbers& n = node.numbers;
        const double size = std::hypot(n[0], n[1], n[2]);
        return shape(Code::planeAt, at, {n[0] / size, n[1] / size, n[2] / size, n[3]});
    }

    double displace(const Node& node, const Place& at) {
        const Numbers& n = node.numbers;
        const double inner = child(node, at);
        Numbers numbers{n[0], n[1], n[2], n[3]};
        // An axis without a frequency does not vary: its sine is that of a quarter turn.
        for (int i = 1; i <= 3; ++i) numbers.push_back(n[i] == 0.0 ? 0.5 * 3.14159265358979323846 : 0.0);
        const double bound = displacementBound(n);
        value(Code::displaceBy, at, numbers, inner + (bound - 1.0) * at.slope);
        return value(Code::scaleValue, at, {1.0 / bound}, (inner + (bound - 1.0) * at.slope) / bound);
    }

    double twist(const Node& node, const Place& at) {
        const double radius = twistRadius(tree_, node), bound = twistBound(node.numbers[0], radius);
        double lipschitz = child(node, move(Code::twistBy, at, {node.numbers[0] * kRadians, radius}, bound));
        lipschitz = value(Code::scaleValue, at, {1.0 / bound}, lipschitz / bound);
        return value(Code::withinRadius, at, {radius}, std::max(lipschitz, at.slope));
    }

    double scale(const Node& node, const Place& at, const Numbers& factors) {
        const double least = std::min({factors[0], factors[1], factors[2]});
        const Place inner =
            move(Code::stretchBy, at, {1.0 / factors[0], 1.0 / factors[1], 1.0 / factors[2]}, 1.0 / least);
        return value(Code::scaleValue, at, {least}, child(node, inner) * least);
    }

    /// Of the nearest cell alone. That is the nearest copy where the child is even; elsewhere the next cell's
    /// copy may be nearer, but no nearer than the wall and the copy's distance from it.
    double repeat(const Node& node, const Place& at) {
        const Repetition cells = repetitionOf(tree_, node);
        Numbers numbers(cells.spacing.begin(), cells.spacing.end());
        numbers.insert(numbers.end(), cells.count.begin(), cells.count.end());
        double lipschitz = child(node, move(Code::repeatBy, at, numbers));
        if (!cells.walls) return lipschitz;
        // On such a wall the bound would be 0, as on a surface.
        if (cells.least_margin == 0.0)
            throw SceneError(node.path,
                             "repeats a child that fills its cells and is not its own mirror image");
        lipschitz = std::max(lipschitz, raiseToBox(at, cells.box));
        numbers.insert(numbers.end(), cells.margin.begin(), cells.margin.end());
        return value(Code::withinWalls, at, numbers, std::max(lipschitz, at.slope));
    }

    /// A child that is a bound may be less than its distance from a wall, and then jump there: it is raised
    /// to the distance from its box, which does not.
    double raiseToBox(const Place& at, const Box& box) {
        Place second = at;
        ++second.value, ++second.position;
        requireSlot(second.value);
        tape_.values = std::max(tape_.values, second.value + 1);
        Numbers middle(3), half(3);
        for (int i = 0; i < 3; ++i) {
            const bool cut = std::isfinite(box.low[i]) && std::isfinite(box.high[i]);
            middle[i] = cut ? 0.5 * (box.low[i] + box.high[i]) : 0.0;
            half[i] = cut ? 0.5 * (box.high[i] - box.low[i]) : 1e9;
        }
        shape(Code::boxAt, move(Code::translateBy, second, middle), half);
        return pair(Code::intersect, at, {}, at.slope);
    }

    double emitKind(const Node& node, const Place& at) {
        const Numbers& n = node.numbers;
        switch (node.kind) {
            case Kind::kSphere:
                return shape(Code::sphereAt, at, n);
            case Kind::kBox:
                return shape(Code::boxAt, at, {n[0] / 2, n[1] / 2, n[2] / 2});
            case Kind::kBoxFrame:
                return shape(Code::boxFrameAt, at, {n[0] / 2, n[1] / 2, n[2] / 2, n[3]});
            case Kind::kTorus:
                return shape(Code::torusAt, at, n);
            case Kind::kCapsule:
                return capsule(node, at);
            case Kind::kCylinder:
                return shape(Code::cylinderAt, at, {n[0], n[1] / 2});
            case Kind::kCone:
                return shape(Code::coneAt, at, {n[0], n[1], n[2] / 2});
            case Kind::kPlane:
                return plane(node, at);
            case Kind::kEllipsoid:
                return shape(Code::ellipsoidAt, at,
                             {1 / n[0], 1 / n[1], 1 / n[2], std::min({n[0], n[1], n[2]})});
            case Kind::kOctahedron:
                return shape(Code::octahedronAt, at, n);
            case Kind::kDodecahedron:
                return shape(Code::dodecahedronAt, at, n);
            case Kind::kIcosahedron:
                return shape(Code::icosahedronAt, at, n);
            case Kind::kHexPrism:
                return shape(Code::hexPrismAt, at, {n[0], n[1] / 2});
            case Kind::kGyroid:
                return shape(Code::gyroidAt, at, {2.0 * 3.14159265358979323846 / n[0], n[1] / 2});
            case Kind::kMenger:
                return menger(node, at);

            case Kind::kUnion:
                return fold(Code::unite, node, at, {});
            case Kind::kIntersection:
                return fold(Code::intersect, node, at, {});
            case Kind::kDifference:
                return fold(Code::subtract, node, at, {});
            case Kind::kSmoothUnion:
                return fold(Code::smoothUnite, node, at, n);
            case Kind::kSmoothIntersection:
                return fold(Code::smoothIntersect, node, at, n);
            case Kind::kSmoothDifference:
                return fold(Code::smoothSubtract, node, at, n);

            case Kind::kComplement:
                return value(Code::complementOf, at, {}, child(node, at));
            case Kind::kOffset:
                return value(Code::offsetBy, at, n, child(node, at));
            case Kind::kShell:
                return value(Code::shellOf, at, {n[0] / 2}, child(node, at));
            case Kind::kScaleValue:
                return value(Code::scaleValue, at, n, child(node, at) * n[0]);
            case Kind::kDisplace:
                return displace(node, at);
            case Kind::kTranslate:
                return child(node, move(Code::translateBy, at, n));
            case Kind::kRotate: {
                const RotationRows rows = rotationRows(n);
                return child(node, move(Code::rotateBy, at, {rows.begin(), rows.end()}));
            }
            case Kind::kScale:
                return scale(node, at, {n[0], n[0], n[0]});
            case Kind::kStretch:
                return scale(node, at, n);
            case Kind::kMirror:
                return child(node, move(Code::foldAxes, at, n));
            case Kind::kRepeat:
                return repeat(node, at);
            case Kind::kElongate:
                return child(node, move(Code::elongateBy, at, {n[0] / 2, n[1] / 2, n[2] / 2}));
            case Kind::kTwist:
                return twist(node, at);
        }
        return 1.0;
    }

    const Tree& tree_;
    Tape tape_;
    std::uint32_t node_ = 0;
};

}  // namespace

Tape lower(const Tree& tree) {
    return Lowering(tree).run();
}

}  // namespace edgewise::sdf
