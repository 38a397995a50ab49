// A value with its derivatives by three variables: forward differentiation. Where a function has a corner or
// a tip, the derivatives are those of one side; at the centre of a length they are 0.
#pragma once

#include <glm/vec3.hpp>

#include "sdf/reals.h"

namespace edgewise::sdf {

struct Dual {
    double value = 0.0;
    glm::dvec3 slope{0.0};
    Dual() = default;
    explicit Dual(double v) : value(v) {}
    Dual(double v, const glm::dvec3& s) : value(v), slope(s) {}
};

inline Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.slope + b.slope};
}
inline Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, a.slope - b.slope};
}
inline Dual operator-(const Dual& a) {
    return {-a.value, -a.slope};
}
inline Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slope * b.value + b.slope * a.value};
}
inline Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value / b.value;
    return {quotient, (a.slope - b.slope * quotient) / b.value};
}
inline Dual square(const Dual& a) {
    return {a.value * a.value, a.slope * (2.0 * a.value)};
}
inline Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return {root, root > 0.0 ? a.slope / (2.0 * root) : glm::dvec3(0.0)};
}
inline Dual abs(const Dual& a) {
    return a.value < 0.0 ? -a : a;
}
inline Dual floor(const Dual& a) {
    return Dual(std::floor(a.value));
}
inline Dual min(const Dual& a, const Dual& b) {
    return b.value < a.value ? b : a;
}
inline Dual max(const Dual& a, const Dual& b) {
    return a.value < b.value ? b : a;
}
inline bool less(const Dual& a, const Dual& b) {
    return a.value < b.value;
}
inline const Dual& choose(bool condition, const Dual& a, const Dual& b) {
    return condition ? a : b;
}
inline Dual sine(const Dual& a) {
    return {sine(a.value), a.slope * cosine(a.value)};
}
inline Dual cosine(const Dual& a) {
    return {cosine(a.value), a.slope * -sine(a.value)};
}

}  // namespace edgewise::sdf
