// shaders/shared/double_double.glsl as C++ double.
#pragma once

#include "analytic/shared_text.h"

namespace edgewise::f64 {
using real = double;
#include "shaders/shared/double_double.glsl"
}  // namespace edgewise::f64
