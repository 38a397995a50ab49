// Arithmetic that gives the same bits on every IEEE machine: +, -, *, / and sqrt only, no libm.
#pragma once

#include <cmath>
#include <cstdint>

namespace edgewise::scenes {

struct Vec2 {
    double x = 0.0, y = 0.0;
};

struct Vec3 {
    double x = 0.0, y = 0.0, z = 0.0;
};

inline Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator*(double s, Vec3 v) {
    return {s * v.x, s * v.y, s * v.z};
}
inline double dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 normalized(Vec3 v) {
    return (1.0 / std::sqrt(dot(v, v))) * v;
}

/// (cos, sin) of a full turn times `turns`; exact at multiples of a quarter.
/// Error    <= 4 * 2^-53 for |turns| < 2^20: the series stops below 1e-19, its argument is rounded twice.
Vec2 onCircle(double turns);

/// Binary logarithm of x >= 1. Error <= 2^-47 for x < 2^32: the digits past the 48th, plus
/// roundings of which each weighs half the former, 2^-52 in all.
double binaryLog(double x);

/// Steele, Lea and Flood's SplitMix64 ("Fast splittable pseudorandom number generators", 2014).
class SplitMix64 {
  public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next();
    /// Uniform on [0, 1), a multiple of 2^-53.
    double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }

  private:
    std::uint64_t state_;
};

/// Uniform on the unit circle, by rejection.
Vec2 randomOnCircle(SplitMix64& random);

/// A uniformly random orthonormal pair: the first two axes of a random rotation (Marsaglia's quaternion,
/// 1972).
struct Axes {
    Vec3 u, v;
};
Axes randomAxes(SplitMix64& random);

}  // namespace edgewise::scenes
