// What the shared SDF text asks of a number, for float and double. Other kinds of numbers (dual.h,
// interval.h, running_error.h, lanes) define the same functions for themselves.
#pragma once

#include <algorithm>
#include <cmath>

#include "analytic/shared_text.h"

namespace edgewise::sdf {

using std::abs;
using std::floor;
using std::sqrt;

#define EDGEWISE_SDF_REAL(real)                               \
    EDGEWISE_FN real min(real a, real b) {                    \
        return b < a ? b : a;                                 \
    }                                                         \
    EDGEWISE_FN real max(real a, real b) {                    \
        return a < b ? b : a;                                 \
    }                                                         \
    EDGEWISE_FN real square(real a) {                         \
        return a * a;                                         \
    }                                                         \
    EDGEWISE_FN bool less(real a, real b) {                   \
        return a < b;                                         \
    }                                                         \
    EDGEWISE_FN real choose(bool condition, real a, real b) { \
        return condition ? a : b;                             \
    }
EDGEWISE_SDF_REAL(float)
EDGEWISE_SDF_REAL(double)
#undef EDGEWISE_SDF_REAL

/// As GLSL and all kinds of numbers have it.
template <class R>
EDGEWISE_FN R clamp(const R& a, const R& low, const R& high) {
    return min(max(a, low), high);
}

namespace sine_float {
using real = float;
#include "shaders/shared/sdf_sine.glsl"
}  // namespace sine_float
namespace sine_double {
using real = double;
#include "shaders/shared/sdf_sine.glsl"
}  // namespace sine_double
EDGEWISE_FN float sine(float x) {
    return sine_float::sine(x);
}
EDGEWISE_FN float cosine(float x) {
    return sine_float::cosine(x);
}
EDGEWISE_FN double sine(double x) {
    return sine_double::sine(x);
}
EDGEWISE_FN double cosine(double x) {
    return sine_double::cosine(x);
}

}  // namespace edgewise::sdf
