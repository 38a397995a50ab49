// shaders/shared/cell_overlap.glsl as C++.
#pragma once

#include <algorithm>
#include <cmath>

#include "analytic/shared_text.h"

namespace edgewise::f64 {
using std::abs, std::max, std::min;
#include "shaders/shared/cell_overlap.glsl"
}  // namespace edgewise::f64
