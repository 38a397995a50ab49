// shaders/shared/transcendental.glsl as C++ double.
#pragma once

#include "analytic/shared_text.h"

// Each text needs the ones before it: blank lines keep a formatter from sorting them.
namespace edgewise::f64 {
#define EDGEWISE_LANES 1
#include "analytic/real_lanes.h"
#undef EDGEWISE_LANES

#include "shaders/shared/double_double.glsl"

#include "shaders/shared/transcendental.glsl"

#include "shaders/shared/erf.glsl"
}  // namespace edgewise::f64
