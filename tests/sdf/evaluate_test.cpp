// The evaluators against each other, against central differences and against known distances.
#include "sdf/evaluate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "sdf/scale_bounds.h"
#include "sdf/tree.h"
#include "tests/sdf/random_tree.h"

namespace edgewise::sdf {
namespace {

constexpr unsigned kSeed = 20261127;

double valueOf(Kind kind, std::vector<double> numbers, const glm::dvec3& p) {
    Tree tree;
    tree.add(kind, std::move(numbers));
    return valueAt(lower(tree), p);
}

template <class Visit>
void forRandomTrees(int count, const Visit& visit) {
    std::set<Kind> seen;
    for (int i = 0; i < count; ++i) {
        RandomTree random(kSeed + static_cast<unsigned>(i));
        const Tree tree = random.make(i % 4);
        for (const Node& node : tree.nodes) seen.insert(node.kind);
        visit(tree, lower(tree), random);
    }
    std::printf("seed %u, %d trees, %zu kinds\n", kSeed, count, seen.size());
    EXPECT_EQ(seen.size(), kindInfos().size());
}

/// A float's, so that running errors can be asked there.
glm::dvec3 randomPoint(RandomTree& random, double reach = 3.0) {
    const glm::vec3 p(random.number(-reach, reach), random.number(-reach, reach),
                      random.number(-reach, reach));
    return p;
}

/// How far double arithmetic may be off at a float's point: the running error of float's, at double's unit.
double roundingAt(const Tape& tape, const glm::dvec3& p) {
    return floatErrorAt(tape, glm::vec3(p)).error * (0x1p-53 / kFloatRounding);
}

TEST(Evaluate, ShapesAreTheDistancesThatOneKnows) {
    EXPECT_EQ(valueOf(Kind::kSphere, {0.5}, {3, 0, 4}), 4.5);
    EXPECT_EQ(valueOf(Kind::kBox, {2, 2, 2}, {4, 5, 0}), 5.0);
    EXPECT_EQ(valueOf(Kind::kBox, {2, 2, 2}, {0.25, 0, 0}), -0.75);
    EXPECT_EQ(valueOf(Kind::kTorus, {4, 1}, {0, 3, 0}), 4.0);
    EXPECT_EQ(valueOf(Kind::kCapsule, {-1, 0, 0, 1, 0, 0, 0.5}, {4, 4, 0}), 4.5);
    EXPECT_EQ(valueOf(Kind::kCylinder, {1, 2}, {4, 5, 0}), 5.0);
    EXPECT_EQ(valueOf(Kind::kCone, {1, 1, 2}, {4, 5, 0}), 5.0);
    EXPECT_NEAR(valueOf(Kind::kCone, {1, 0, 1}, {1, 0.5, 0}), std::sqrt(0.5),
                1e-15);  // from a slope of 45 degrees
    EXPECT_EQ(valueOf(Kind::kPlane, {0, 2, 0, 1}, {7, 4, 7}), 3.0);
    EXPECT_NEAR(valueOf(Kind::kOctahedron, {1}, {1, 1, 1}), 2.0 / std::sqrt(3.0), 1e-15);
    EXPECT_EQ(valueOf(Kind::kHexPrism, {1, 2}, {0, 0, 3}), 2.0);
    // A vertex of the dodecahedron along (1, 1, 1) is at 1.2584 inradii: three faces meet there.
    const double corner = std::sqrt(3.0) * std::tan(std::acos(-1.0) / 5) * 1.0;
    EXPECT_NEAR(valueOf(Kind::kDodecahedron, {1}, glm::dvec3(corner / std::sqrt(3.0))), 0.0, 1e-12) << corner;
}

TEST(Evaluate, MengersSpongeHasItsTunnelsWhereTheyAre) {
    // By the definition: a point is in the sponge of n levels unless some level's cell has two middle
    // coordinates.
    RandomTree random(kSeed);
    int solid = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 p = randomPoint(random, 0.5);
        bool inside = true;
        double cell = 1.0;
        for (int level = 0; level < 3; ++level, cell /= 3.0) {
            int middle = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const double t = (p[axis] + 0.5) / cell;
                middle += static_cast<int>((t - std::floor(t)) * 3.0) == 1;
            }
            inside = inside && middle < 2;
        }
        solid += inside;
        EXPECT_EQ(valueOf(Kind::kMenger, {1, 3}, p) <= 0.0, inside) << p.x << ' ' << p.y << ' ' << p.z;
    }
    EXPECT_NEAR(solid / 20000.0, std::pow(20.0 / 27.0, 3),
                0.02);  // the volume of three levels; 5 sigma are 0.018
}

TEST(Evaluate, GradientsAreCentralDifferences) {
    int compared = 0, corners = 0;
    forRandomTrees(400, [&](const Tree&, const Tape& tape, RandomTree& random) {
        for (int i = 0; i < 10; ++i) {
            const glm::dvec3 p = randomPoint(random);
            const ValueAndGradient at = gradientAt(tape, p);
            ASSERT_EQ(at.value, valueAt(tape, p));
            const double h = 1e-6;
            glm::dvec3 difference, curvature;
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 step(0.0);
                step[axis] = h;
                const double up = valueAt(tape, p + step), down = valueAt(tape, p - step);
                difference[axis] = (up - down) / (2 * h);
                curvature[axis] = (up + down - 2 * at.value) / h;  // of the size of h but at corners
            }
            ++compared;
            if (glm::length(curvature) > 1e-3) {
                ++corners;
                continue;
            }
            // Both one-sided slopes are within the curvature of the difference; the values' rounding is
            // divided by h.
            const double rounding = 8.0 * roundingAt(tape, p) / h;
            EXPECT_LE(glm::length(difference - at.gradient), glm::length(curvature) + rounding)
                << tape.size();
        }
    });
    std::printf("%d gradients, %d at corners\n", compared, corners);
    EXPECT_LT(corners, compared / 100);
}

TEST(Evaluate, IntervalsHoldTheValues) {
    double tightness = 0.0;
    int boxes = 0;
    forRandomTrees(400, [&](const Tree&, const Tape& tape, RandomTree& random) {
        for (int i = 0; i < 5; ++i) {
            const glm::dvec3 low = randomPoint(random);
            const double size = std::exp2(random.number(-12.0, 1.0));
            const Interval box[3] = {{low.x, low.x + size}, {low.y, low.y + size}, {low.z, low.z + size}};
            const Interval values = valuesIn(tape, box);
            for (int k = 0; k < 20; ++k) {
                const glm::dvec3 p =
                    low + size * glm::dvec3(random.number(0, 1), random.number(0, 1), random.number(0, 1));
                EXPECT_TRUE(values.holds(valueAt(tape, p)));
            }
            tightness += std::min(100.0, (values.high - values.low) / size), ++boxes;
        }
    });
    std::printf("%d boxes, mean width over size %.2f\n", boxes, tightness / boxes);
    EXPECT_LT(tightness / boxes, 30.0);  // an interval of everything would hold all values too
}

TEST(Evaluate, FloatStaysWithinItsRunningError) {
    double worst = 0.0;
    int bounded = 0, points = 0;
    forRandomTrees(400, [&](const Tree&, const Tape& tape, RandomTree& random) {
        for (int i = 0; i < 20; ++i) {
            const glm::vec3 p(randomPoint(random));
            const RunningError bound = floatErrorAt(tape, p);
            ASSERT_EQ(bound.value, valueAt(tape, glm::dvec3(p)));
            const double off = std::abs(valueAt(tape, p) - bound.value);
            EXPECT_LE(off, bound.error);
            ++points;
            if (bound.error < 1e-4) ++bounded, worst = std::max(worst, off / bound.error);
        }
    });
    std::printf("%d points, %d bounded below 1e-4, worst share of its bound %.2f\n", points, bounded, worst);
    EXPECT_GT(bounded, points * 9 / 10);  // the bound says something
    EXPECT_GT(worst, 0.02);
}

TEST(Evaluate, ValuesChangeNoFasterThanTheirBounds) {
    double steepest = 0.0;
    forRandomTrees(400, [&](const Tree&, const Tape& tape, RandomTree& random) {
        for (int i = 0; i < 50; ++i) {
            const glm::dvec3 a = randomPoint(random);
            const double size = std::exp2(random.number(-10.0, 2.0));
            const glm::dvec3 b(glm::vec3(a + size * randomPoint(random, 1.0)));
            const double change = std::abs(valueAt(tape, a) - valueAt(tape, b)),
                         distance = glm::length(a - b);
            EXPECT_LE(change, tape.lipschitz * distance + roundingAt(tape, a) + roundingAt(tape, b))
                << tape.size();
            steepest = std::max(steepest, change / (tape.lipschitz * distance));
        }
    });
    std::printf("steepest %.4f of the bound\n", steepest);
    EXPECT_GT(steepest, 0.99);
}

TEST(Evaluate, ValuesAreNoLargerThanDistances) {
    // Along random segments, a change of sign is a surface: no end may claim to be further from it.
    int crossings = 0;
    forRandomTrees(400, [&](const Tree&, const Tape& tape, RandomTree& random) {
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 a = randomPoint(random), b = randomPoint(random);
            const double at_a = valueAt(tape, a), at_b = valueAt(tape, b);
            if ((at_a < 0.0) == (at_b < 0.0)) continue;
            double low = 0.0, high = 1.0;
            for (int k = 0; k < 60; ++k) {
                const double middle = 0.5 * (low + high);
                ((valueAt(tape, a + middle * (b - a)) < 0.0) == (at_a < 0.0) ? low : high) = middle;
            }
            ++crossings;
            // The value where the sign changes is 0 to within what it may be off; a's and b's points stand
            // for it.
            const double off = 2.0 * (roundingAt(tape, a) + roundingAt(tape, b));
            EXPECT_LE(std::abs(at_a), tape.lipschitz * low * glm::length(b - a) + off);
            EXPECT_LE(std::abs(at_b), tape.lipschitz * (1.0 - low) * glm::length(b - a) + off);
        }
    });
    std::printf("%d crossings\n", crossings);
    EXPECT_GT(crossings, 200);
}

TEST(Evaluate, LevelBoxesHoldTheirSolids) {
    int inside = 0;
    forRandomTrees(400, [&](const Tree& tree, const Tape& tape, RandomTree& random) {
        const double level = random.number(0.0, 0.5);
        const Box box = levelBox(tree, tree.root, level);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 p = randomPoint(random);
            if (valueAt(tape, p) > level - roundingAt(tape, p)) continue;
            ++inside;
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_LE(box.low[axis], p[axis]);
                EXPECT_GE(box.high[axis], p[axis]);
            }
        }
    });
    std::printf("%d points inside\n", inside);
    EXPECT_GT(inside, 500);
}

TEST(Evaluate, TheWinnerGivesTheValueOfSharpTrees) {
    // A union of spheres: the winner is the nearest, in its own frame.
    Tree tree;
    std::vector<std::uint32_t> children;
    RandomTree random(kSeed);
    std::vector<glm::dvec3> centres;
    for (std::uint32_t i = 0; i < 20; ++i) {
        centres.push_back(randomPoint(random));
        const std::uint32_t sphere = tree.add(Kind::kSphere, {0.1}, {}, i);
        children.push_back(tree.add(Kind::kTranslate, {centres[i].x, centres[i].y, centres[i].z}, {sphere}));
    }
    tree.add(Kind::kUnion, {}, children);
    const Tape tape = lower(tree);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 p = randomPoint(random);
        glm::dvec3 local;
        const Instruction& winner = winnerAt(tape, p, local);
        for (const glm::dvec3& centre : centres)
            EXPECT_LE(glm::length(p - centres[winner.material]), glm::length(p - centre));
        EXPECT_EQ(glm::length(local) - 0.1, valueAt(tape, p));
    }
}

}  // namespace
}  // namespace edgewise::sdf
