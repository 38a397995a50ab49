// The shared text of shading as C++: vectors are glm's.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "analytic/transcendental.h"

// Each text needs the ones before it: blank lines keep a formatter from sorting them.
namespace edgewise::f64 {
using glm::dvec2, glm::dvec3, glm::dvec4;
using std::floor, std::ceil;
using bits64 = std::int64_t;

#include "shaders/shared/vectors.glsl"

#include "shaders/shared/surface_point.glsl"

#include "shaders/shared/brdf.glsl"

#include "shaders/shared/lighting.glsl"

#include "shaders/shared/normal_map.glsl"

#include "shaders/shared/over.glsl"

#include "shaders/shared/blend.glsl"
}  // namespace edgewise::f64
