// Tapes at eight points at once, for one instruction set: plain data alone crosses, so that nothing compiled
// for a newer machine can be linked into code for an older one.
#pragma once

#include "sdf/tape.h"

namespace edgewise::sdf {

/// As many points as one pass over a tape takes, whatever the machine.
inline constexpr int kPointLanes = 8;

/// By axis and lane.
struct LanePoints {
    alignas(64) double axis[3][kPointLanes];
};

using LaneValuesFunction = void (*)(const Instruction* begin, const Instruction* end, const double* numbers,
                                    const LanePoints& p_world, double* values);

/// The form for an instruction set's name (cmake/lanes.cmake); nullptr: this machine has none of it.
LaneValuesFunction laneValuesFor(const char* instruction_set);

/// The values at the points, to the last bit what valueAt() says of each.
void laneValues(const Tape& tape, const LanePoints& p_world, double (&values)[kPointLanes]);

}  // namespace edgewise::sdf
