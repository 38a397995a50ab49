// Random SDF trees that hold every kind of node, for tests of evaluators against each other.
#pragma once

#include <random>

#include "sdf/scene_error.h"
#include "sdf/tree.h"

namespace edgewise::sdf::test {

class RandomTrees {
  public:
    explicit RandomTrees(std::uint64_t seed) : random_(seed) {}

    /// One that can be lowered: random kinds with random numbers, at most `depth` operators deep.
    Tree next(int depth) {
        while (true) {
            Tree tree;
            tree.root = node(tree, depth);
            try {
                static_cast<void>(lower(tree));
                return tree;
            } catch (const SceneError&) {  // a repeated child that does not fit, a twisted one without bounds
            }
        }
    }

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }

  private:
    double number(const NumberInfo& info) {
        if (info.name == "spacing") return uniform(3.0, 6.0);  // what is repeated fits
        switch (info.rule) {
            case Rule::kAny:
                return uniform(-1.0, 1.0);
            case Rule::kCount:
            case Rule::kSwitch:
                return static_cast<double>(random_() % (info.rule == Rule::kSwitch ? 2 : 4));
            default:
                return uniform(0.1, 1.0);
        }
    }

    std::uint32_t node(Tree& tree, int depth) {
        const std::vector<KindInfo>& kinds = kindInfos();
        while (true) {
            const KindInfo& info = kinds[random_() % kinds.size()];
            const bool leaf = info.children == KindInfo::Children::kNone;
            if (leaf != (depth == 0) && !(leaf && random_() % 4 == 0)) continue;
            std::vector<std::uint32_t> children;
            const std::size_t count = leaf                                        ? 0
                                      : info.children == KindInfo::Children::kOne ? 1
                                                                                  : 1 + random_() % 3;
            for (std::size_t i = 0; i < count; ++i) children.push_back(node(tree, depth - 1));
            std::vector<double> numbers;
            for (const NumberInfo& n : info.numbers)
                for (int i = 0; i < (n.vector ? 3 : 1); ++i) numbers.push_back(number(n));
            return tree.add(info.kind, numbers, children, static_cast<std::uint32_t>(random_() % 5));
        }
    }

    std::mt19937_64 random_;
};

}  // namespace edgewise::sdf::test
