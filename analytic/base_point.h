// shaders/shared/base_point.glsl as C++.
#pragma once

#include "analytic/lane_kernel.h"
#include "analytic/transcendental.h"

namespace edgewise::f64 {
using uint = unsigned;
#include "shaders/shared/base_point.glsl"
}  // namespace edgewise::f64
