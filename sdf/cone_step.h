// The shared text of cone tracing in double.
#pragma once

#include <cstdint>

#include "sdf/reals.h"

namespace edgewise::sdf::cones {

using real = double;
using uint = std::uint32_t;
using sdf::max, sdf::min, sdf::sqrt;
#include "shaders/shared/sdf_cone_step.glsl"

}  // namespace edgewise::sdf::cones
