// shaders/shared/segment_tiles.glsl as C++.
#pragma once

#include <algorithm>
#include <cmath>

#include "analytic/shared_text.h"

namespace edgewise::f64 {
using std::floor, std::max, std::min;
#include "shaders/shared/segment_tiles.glsl"
}  // namespace edgewise::f64
