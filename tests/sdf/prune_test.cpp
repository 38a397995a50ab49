#include "sdf/prune.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/evaluate.h"
#include "tests/sdf/random_tree.h"

namespace edgewise::sdf {
namespace {

constexpr unsigned kSeed = 7771;

glm::dvec3 inBall(RandomTree& random) {
    for (;;) {
        const glm::dvec3 p(random.number(-1, 1), random.number(-1, 1), random.number(-1, 1));
        if (glm::dot(p, p) <= 1.0) return p;
    }
}

Tree manySpheres(int count, double smoothness, unsigned seed) {
    RandomTree random(seed);
    Tree tree;
    std::vector<std::uint32_t> children;
    for (int i = 0; i < count; ++i) {
        const std::uint32_t sphere = tree.add(Kind::kSphere, {random.number(0.02, 0.06)});
        children.push_back(tree.add(
            Kind::kTranslate, {random.number(-1, 1), random.number(-1, 1), random.number(-1, 1)}, {sphere}));
    }
    tree.add(Kind::kSmoothUnion, {smoothness}, children);
    return tree;
}

TEST(Prune, EveryBitOfTheBallIsKept) {
    std::size_t before = 0, after = 0;
    for (int i = 0; i < 600; ++i) {
        RandomTree random(kSeed + static_cast<unsigned>(i));
        const Tape tape = lower(random.make(1 + i % 4));
        const glm::dvec3 centre(random.number(-2, 2), random.number(-2, 2), random.number(-2, 2));
        const double radius = std::exp2(random.number(-8.0, 0.0));
        const Tape shorter = pruneTape(tape, centre, radius);
        const Tape single = pruneTape(tape, centre, radius, kSingleRounding);
        before += tape.size(), after += shorter.size();
        for (int k = 0; k < 30; ++k) {
            const glm::dvec3 p = centre + radius * inBall(random);
            EXPECT_EQ(valueAt(shorter, p), valueAt(tape, p)) << "tree " << kSeed + static_cast<unsigned>(i);
            EXPECT_EQ(valueAt(single, glm::vec3(p)), valueAt(tape, glm::vec3(p)));
        }
    }
    std::printf("seed %u: %zu instructions before, %zu after\n", kSeed, before, after);
    EXPECT_LT(after, before * 3 / 4);
}

TEST(Prune, AThousandSmoothSpheresShrinkToTheFewThatCount) {
    const Tape tape = lower(manySpheres(1000, 0.05, kSeed));
    RandomTree random(kSeed);
    std::size_t kept = 0;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 centre(random.number(-1, 1), random.number(-1, 1), random.number(-1, 1));
        const Tape shorter = pruneTape(tape, centre, 0.02);
        const Tape again = pruneTape(shorter, centre + glm::dvec3(0.01, 0, 0), 0.01);
        kept += shorter.size();
        EXPECT_LE(again.size(), shorter.size());
        for (int k = 0; k < 20; ++k) {
            const glm::dvec3 p = centre + 0.02 * inBall(random);
            EXPECT_EQ(valueAt(shorter, p), valueAt(tape, p));
        }
    }
    std::printf("%zu instructions, %.1f kept in a ball of 0.02\n", tape.size(), kept / 100.0);
    EXPECT_LT(kept / 100, tape.size() / 50);
}

TEST(Prune, AFieldWithoutPairsStays) {
    Tree tree;
    tree.add(Kind::kSphere, {1.0});
    EXPECT_EQ(pruneTape(lower(tree), {0, 0, 0}, 1.0).size(), 1u);
}

}  // namespace
}  // namespace edgewise::sdf
