// Shorter tapes for parts of space: what cannot win a union, an intersection or a difference there is left
// out.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sdf/tape_lanes.h"

namespace edgewise::sdf {

/// The arithmetic that will run the shorter tape: half a unit of its last place.
inline constexpr double kDoubleRounding = 0x1p-53, kSingleRounding = 0x1p-24;

/// A tape with the same value, to the last bit, at every point within `radius` of the centre: after Barbier
/// et al. 2025, "Lipschitz pruning". A value v at the centre is within v +- lipschitz * radius in the ball;
/// where two sides of a pair are apart by more than that, by the pair's smoothness and by what rounding may
/// move them, one of them is the result. Steps stay: the shorter tape has the whole one's Lipschitz bound. A
/// tape that is empty of pairs is returned as it is. Where bounds do not hold (check_lipschitz), neither does
/// this.
Tape pruneTape(const Tape& tape, const glm::dvec3& centre_world, double radius,
               double rounding = kDoubleRounding);

/// No code makes more of them on the way to its result, each of a number no larger than what it was given.
inline constexpr double kRoundingsAnInstruction = 32.0;

/// The picks of eight shorter tapes, each at the end of its part of the buffer; reused from one to the next.
struct PickLists {
    std::vector<Pick> buffer;
    std::size_t room = 0;  ///< of each part
    std::array<std::size_t, kPointLanes> begin{};
    std::span<const Pick> of(int ball) const {
        return std::span(buffer).subspan(begin[ball], (ball + 1) * room - begin[ball]);
    }
};

/// The same in double, for eight balls of one size at a time, of a tape that may be a shortened one.
void pruneEight(const TapeView& tape, int positions, int values, const LanePoints& centres_world,
                double radius, PickLists& shorter);

}  // namespace edgewise::sdf
