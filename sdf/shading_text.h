// shaders/shared/sdf_shading.glsl, sdf_path.glsl and sdf_lottes.glsl as C++: double in `shading`, and float
// as GLSL has it in `shading_float`.
#pragma once

#include <glm/glm.hpp>

#include "analytic/transcendental.h"
#include "sdf/reals.h"

namespace edgewise::sdf {

/// e^x and x^y from + - * / alone: the same bits on every machine. x^y is 0 for x <= 0.
inline double exponential(double x) {
    return x <= 0.0 ? f64::expReal(std::max(x, -700.0)) : 1.0 / f64::expReal(std::max(-x, -700.0));
}
inline double powerOf(double x, double y) {
    return x > 0.0 ? exponential(y * f64::logReal(x)) : 0.0;
}
inline float exponential(float x) {
    return static_cast<float>(exponential(static_cast<double>(x)));
}
inline float powerOf(float x, float y) {
    return static_cast<float>(powerOf(static_cast<double>(x), static_cast<double>(y)));
}

namespace shading {
using real = double;
using vec3 = glm::dvec3;
using glm::dot, glm::length;
#include "shaders/shared/sdf_shading.glsl"

#include "shaders/shared/sdf_path.glsl"

#include "shaders/shared/sdf_lottes.glsl"
}  // namespace shading
namespace shading_float {
using real = float;
using vec3 = glm::vec3;
using glm::dot, glm::length;
#include "shaders/shared/sdf_shading.glsl"

#include "shaders/shared/sdf_path.glsl"

#include "shaders/shared/sdf_lottes.glsl"
}  // namespace shading_float

}  // namespace edgewise::sdf
