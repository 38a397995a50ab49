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

using LaneValuesFunction = void (*)(const TapeView& tape, const LanePoints& p_world, double* values);

/// The form for an instruction set's name (cmake/lanes.cmake); nullptr: this machine has none of it.
LaneValuesFunction laneValuesFor(const char* instruction_set);

/// The values at the points, to the last bit what valueAt() says of each.
void laneValues(const TapeView& tape, const LanePoints& p_world, double (&values)[kPointLanes]);

/// Eight balls of one size.
struct LaneBalls {
    LanePoints centre_world;
    double radius;
    double rounding;  ///< of all arithmetic on the way to a value, as a part of it
};

/// Of an instruction, what shortening a tape asks, side by side; of a pair besides in which balls (a bit
/// each) its first side is the result everywhere, and in which its second.
struct Verdict {
    CodeForm form;
    bool negates;           ///< of pairs: the second side
    std::uint8_t to, from;  ///< slots: `from` is what a shape or a move is asked at, else Instruction::b
    std::uint8_t first, second;
};

using LaneVerdictsFunction = void (*)(const TapeView& tape, const LaneBalls& balls, Verdict* verdicts);
LaneVerdictsFunction laneVerdictsFor(const char* instruction_set);

/// One an instruction: what pruneTape() decides, of each ball.
void laneVerdicts(const TapeView& tape, const LaneBalls& balls, Verdict* verdicts);

}  // namespace edgewise::sdf
