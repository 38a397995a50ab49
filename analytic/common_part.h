// shaders/shared/common_part.glsl as C++.
#pragma once

#include <algorithm>
#include <cmath>

#include "analytic/local_plane.h"
#include "analytic/shared_text.h"

namespace edgewise::f64 {
using glm::dvec2;
using std::abs, std::max;
using uint = unsigned;
#include "shaders/shared/common_part.glsl"
}  // namespace edgewise::f64
