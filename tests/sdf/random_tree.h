// Random trees of every kind of node, for tests that ask what holds of all of them.
#pragma once

#include <random>

#include "sdf/tree.h"

namespace edgewise::sdf {

/// Its numbers are of the size of 1, its solids lie within a few units of the origin.
class RandomTree {
  public:
    explicit RandomTree(unsigned seed) : random_(seed) {}

    /// At most `depth` operators above any shape.
    Tree make(int depth) {
        Tree tree;
        tree.root = node(tree, depth);
        return tree;
    }
    double number(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
    int whole(int low, int high) { return std::uniform_int_distribution<>(low, high)(random_); }

  private:
    static constexpr int kShapes = static_cast<int>(Kind::kMenger) + 1;
    static constexpr int kKinds = static_cast<int>(Kind::kTwist) + 1;

    std::uint32_t node(Tree& tree, int depth) {
        const auto kind = static_cast<Kind>(depth == 0 ? whole(0, kShapes - 1) : whole(kShapes, kKinds - 1));
        const KindInfo& info = kindInfo(kind);
        std::vector<std::uint32_t> children;
        const int count = info.children == KindInfo::Children::kNone  ? 0
                          : info.children == KindInfo::Children::kOne ? 1
                                                                      : whole(2, 4);
        for (int i = 0; i < count; ++i) children.push_back(node(tree, whole(0, depth - 1)));
        if (kind == Kind::kRepeat || kind == Kind::kTwist) children = {bounded(tree, children[0], 0.6)};
        std::vector<double> numbers;
        for (const NumberInfo& n : info.numbers)
            for (int i = 0; i < (n.vector ? 3 : 1); ++i) numbers.push_back(numberOf(kind, n));
        return tree.add(kind, numbers, children, static_cast<std::uint32_t>(tree.nodes.size()));
    }

    /// The part of a node within a cube.
    std::uint32_t bounded(Tree& tree, std::uint32_t child, double size) {
        const std::uint32_t box = tree.add(Kind::kBox, {size, size, size});
        return tree.add(Kind::kIntersection, {}, {box, child});
    }

    double numberOf(Kind kind, const NumberInfo& n) {
        if (n.name == "degrees" || n.name == "degrees_per_unit") return number(-120.0, 120.0);
        if (n.name == "levels") return whole(1, 3);
        if (n.name == "amplitude") return number(0.01, 0.1);
        if (n.name == "frequency") return whole(0, 3) == 0 ? 0.0 : number(1.0, 9.0);
        if (kind == Kind::kRepeat) return n.rule == Rule::kCount ? whole(0, 2) : number(0.8, 1.5);
        if (n.name == "thickness") return number(0.02, 0.2);
        switch (n.rule) {
            case Rule::kSwitch:
                return whole(0, 1);
            case Rule::kPositive:
                return number(0.3, 1.2);
            case Rule::kNotNegative:
                return number(0.0, 1.0);
            default:
                return number(-1.0, 1.0);
        }
    }

    std::mt19937 random_;
};

}  // namespace edgewise::sdf
