// Three coordinates of any kind of number that sdf/ evaluates with: GLSL's vec3, as far as the shared text
// uses it.
#pragma once

#include "sdf/reals.h"

namespace edgewise::sdf {

template <class R>
struct Vec3 {
    R x, y, z;
    Vec3() = default;
    explicit Vec3(const R& all) : x(all), y(all), z(all) {}
    Vec3(const R& x_, const R& y_, const R& z_) : x(x_), y(y_), z(z_) {}
};

template <class R>
EDGEWISE_FN Vec3<R> operator+(const Vec3<R>& a, const Vec3<R>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class R>
EDGEWISE_FN Vec3<R> operator-(const Vec3<R>& a, const Vec3<R>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class R>
EDGEWISE_FN Vec3<R> operator-(const Vec3<R>& a) {
    return {-a.x, -a.y, -a.z};
}
template <class R>
EDGEWISE_FN Vec3<R> operator*(const Vec3<R>& a, const Vec3<R>& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class R>
EDGEWISE_FN Vec3<R> operator*(const Vec3<R>& a, const R& b) {
    return {a.x * b, a.y * b, a.z * b};
}
template <class R>
EDGEWISE_FN Vec3<R> operator/(const Vec3<R>& a, const R& b) {
    return {a.x / b, a.y / b, a.z / b};
}
template <class R>
EDGEWISE_FN Vec3<R> abs(const Vec3<R>& a) {
    return {abs(a.x), abs(a.y), abs(a.z)};
}
template <class R>
EDGEWISE_FN Vec3<R> max(const Vec3<R>& a, const Vec3<R>& b) {
    return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
}
template <class R>
EDGEWISE_FN Vec3<R> min(const Vec3<R>& a, const Vec3<R>& b) {
    return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}
template <class R>
EDGEWISE_FN Vec3<R> clamp(const Vec3<R>& a, const Vec3<R>& low, const Vec3<R>& high) {
    return min(max(a, low), high);
}
template <class R>
EDGEWISE_FN R dot(const Vec3<R>& a, const Vec3<R>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R>
EDGEWISE_FN R length(const Vec3<R>& a) {
    return sqrt(square(a.x) + square(a.y) + square(a.z));
}

}  // namespace edgewise::sdf
