// The shared text of sphere tracing in double.
#pragma once

#include "sdf/reals.h"

namespace edgewise::sdf::tracing {

using real = double;
using sdf::max, sdf::min;
#include "shaders/shared/sdf_trace_step.glsl"

}  // namespace edgewise::sdf::tracing
