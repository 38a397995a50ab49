#include "sdf/cell_tapes.h"

#include <gtest/gtest.h>

#include <bit>
#include <glm/geometric.hpp>
#include <thread>

#include "sdf/evaluate.h"
#include "sdf/prune.h"
#include "tests/sdf/random_tree.h"

namespace edgewise::sdf {
namespace {

constexpr unsigned kSeed = 4243;

glm::dvec3 inCube(RandomTree& random, double half) {
    return {random.number(-half, half), random.number(-half, half), random.number(-half, half)};
}

Tree manySpheres(int count) {
    RandomTree random(kSeed);
    Tree tree;
    std::vector<std::uint32_t> children;
    for (int i = 0; i < count; ++i) {
        const std::uint32_t sphere = tree.add(Kind::kSphere, {random.number(0.05, 0.2)});
        const glm::dvec3 at = inCube(random, 1.0);
        children.push_back(tree.add(Kind::kTranslate, {at.x, at.y, at.z}, {sphere}));
    }
    tree.add(Kind::kSmoothUnion, {0.05}, children);
    return tree;
}

/// Asks often enough that cells are cut; counts the instructions that single points took.
std::uint64_t askEverywhere(const CellTapes& cells, const Tape& tape, unsigned seed, int points) {
    RandomTree random(seed);
    std::uint64_t instructions = 0;
    const TapeCell* near = nullptr;
    for (int k = 0; k < points; ++k) {
        const glm::dvec3 p = k % 8 == 0 ? inCube(random, 4.0) : inCube(random, 0.5);
        const TapeCell& cell = cells.at(p, near);
        near = k % 3 == 0 ? nullptr : &cell;
        instructions += cell.tape.size();
        EXPECT_EQ(valueAt(cell.tape, p), valueAt(tape, p)) << "seed " << seed;
        glm::dvec3 local, whole_local;
        EXPECT_EQ(winnerAt(cell.tape, p, local).node, winnerAt(tape, p, whole_local).node);
        EXPECT_EQ(local, whole_local);
        EXPECT_EQ(gradientAt(cell.tape, p).gradient, gradientAt(tape, p).gradient);
        cells.ran(cell, 20);
    }
    return instructions;
}

TEST(CellTapes, EveryCellHasTheWholeTapesBits) {
    std::uint64_t made = 0;
    for (unsigned seed = kSeed; seed < kSeed + 150; ++seed) {
        const Tape tape = lower(RandomTree(seed).make(1 + seed % 5));
        const CellTapes cells(tape, {0.1, -0.2, 0.3}, 3.0, true);
        askEverywhere(cells, tape, seed, 400);
        made += cells.counts().tapes;
    }
    std::printf("seed %u: %llu tapes made\n", kSeed, static_cast<unsigned long long>(made));
    EXPECT_GT(made, 1000u);
}

TEST(CellTapes, AreMuchShorterWhereManySpheresAre) {
    const Tape tape = lower(manySpheres(500));
    const CellTapes cells(tape, {0, 0, 0}, 2.0, true), off(tape, {0, 0, 0}, 2.0, false);
    askEverywhere(cells, tape, kSeed, 4000);
    const std::uint64_t asked = askEverywhere(cells, tape, kSeed + 1, 1000);
    EXPECT_LT(asked, tape.size() * 1000 / 5);
    EXPECT_EQ(askEverywhere(off, tape, kSeed, 100), tape.size() * 100);
    EXPECT_EQ(off.counts().tapes, 0u);
}

TEST(CellTapes, WideCellsAreCutForNarrowRays) {
    const Tape tape = lower(manySpheres(500));
    const CellTapes cells(tape, {0, 0, 0}, 2.0, true);
    PruneCounts counts;
    const glm::dvec3 p(0.3, 0.2, 0.1);
    const TapeCell& wide = cells.at(p);
    EXPECT_EQ(wide.tape.size(), tape.size());
    const TapeCell& narrow = cells.at(p, &wide, 1e-3, counts);
    EXPECT_LT(narrow.tape.size(), tape.size() / 10);
    EXPECT_TRUE(narrow.holds(p));
    EXPECT_EQ(counts.tapes, cells.counts().tapes);
    EXPECT_EQ(valueAt(narrow.tape, p), valueAt(tape, p));
}

TEST(CellTapes, ServeManyThreadsAtOnce) {
    const Tape tape = lower(manySpheres(100));
    const CellTapes cells(tape, {0, 0, 0}, 2.0, true);
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < 4; ++t) threads.emplace_back([&, t] { askEverywhere(cells, tape, t, 2000); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_GT(cells.counts().tapes, 100u);
}

TEST(CellTapes, EightBallsAtOnceKeepWhatOneAtATimeKeeps) {
    std::size_t shorter = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        RandomTree random(seed);
        const Tape tape = lower(random.make(4));
        LanePoints centres;
        for (auto& axis : centres.axis)
            for (double& x : axis) x = random.number(-2.0, 2.0);
        const double radius = std::exp2(random.number(-8.0, 0.0));
        PickLists lists;
        pruneEight(tape, tape.positions, tape.values, centres, radius, lists);
        for (int ball = 0; ball < kPointLanes; ++ball) {
            const glm::dvec3 centre(centres.axis[0][ball], centres.axis[1][ball], centres.axis[2][ball]);
            const Tape one = pruneTape(tape, centre, radius);
            ASSERT_EQ(lists.of(ball).size(), one.size()) << "seed " << seed;
            shorter += one.size() < tape.size();
            for (std::size_t n = 0; n < one.size(); ++n) {
                const Pick pick = lists.of(ball)[n];
                EXPECT_EQ(TapeView::codeOf(tape.instructions[pick.index], pick), one.instructions[n].code);
            }
        }
    }
    EXPECT_GT(shorter, 500u);
}

}  // namespace
}  // namespace edgewise::sdf
