// A tape's value at points, in every kind of number.
#pragma once

#include <glm/vec3.hpp>

#include "sdf/interval.h"
#include "sdf/running_error.h"
#include "sdf/tape.h"

namespace edgewise::sdf {

double valueAt(const TapeView& tape, const glm::dvec3& p_world);
float valueAt(const TapeView& tape, const glm::vec3& p_world);

struct ValueAndGradient {
    double value;
    glm::dvec3 gradient;  ///< not normalised: its length is the field's slope
};
ValueAndGradient gradientAt(const TapeView& tape, const glm::dvec3& p_world);

/// Holds the value at every point of the box.
Interval valuesIn(const TapeView& tape, const Interval (&box)[3]);

/// The value in double, and how far float arithmetic with Vulkan's precisions may be from it.
RunningError floatErrorAt(const TapeView& tape, const glm::vec3& p_world);

/// The shape that gives the value at a point: its instruction. Of pairs the side that wins: the nearer of
/// unions, the farther of intersections, the cutting shape where a difference is its cut.
const Instruction& winnerAt(const TapeView& tape, const glm::dvec3& p_world, glm::dvec3& p_local);

/// A point in the frame of one of the tape's shapes, whichever wins there.
glm::dvec3 localAt(const TapeView& tape, const Instruction& shape, const glm::dvec3& p_world);

}  // namespace edgewise::sdf
