#include "sdf/tape_lanes.h"

#include <gtest/gtest.h>

#include <bit>

#include "random_tree.h"
#include "sdf/evaluate.h"
#include "trace_scenes.h"

namespace edgewise::sdf {
namespace {

LanePoints randomPoints(std::mt19937_64& random) {
    std::uniform_real_distribution<double> at(-3.0, 3.0);
    LanePoints points;
    for (auto& axis : points.axis)
        for (double& x : axis) x = at(random);
    return points;
}

void expectScalarBits(const Tape& tape, LaneValuesFunction values, const LanePoints& p, const char* isa) {
    alignas(64) double lanes[kPointLanes];
    values(tape, p, lanes);
    for (int i = 0; i < kPointLanes; ++i) {
        const double alone = valueAt(tape, glm::dvec3(p.axis[0][i], p.axis[1][i], p.axis[2][i]));
        EXPECT_EQ(std::bit_cast<std::uint64_t>(lanes[i]), std::bit_cast<std::uint64_t>(alone))
            << isa << " lane " << i << ": " << lanes[i] << " instead of " << alone;
    }
}

TEST(TapeLanes, EveryInstructionSetHasTheBitsOfSinglePoints) {
    std::mt19937_64 random(99);
    int forms = 0;
    for (const char* isa : {"scalar", "sse2", "avx2", "avx512"}) {
        const LaneValuesFunction values = laneValuesFor(isa);
        if (!values) continue;
        ++forms;
        for (const TraceScene& scene : traceScenes()) {
            const Tape tape = lower(scene.tree);
            for (int i = 0; i < 100; ++i) expectScalarBits(tape, values, randomPoints(random), isa);
        }
        for (unsigned seed = 0; seed < 300; ++seed) {  // every kind of node
            const Tape tape = lower(RandomTree(seed).make(3));
            for (int i = 0; i < 10; ++i) expectScalarBits(tape, values, randomPoints(random), isa);
        }
    }
    EXPECT_GE(forms, 1);
}

}  // namespace
}  // namespace edgewise::sdf
