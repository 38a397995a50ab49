// What the makers of stiff scenes share: the pixel they are about, random numbers, sweeps.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <random>
#include <vector>

namespace edgewise::judge {

using glm::dvec2;
using glm::dvec3;
inline constexpr glm::ivec2 kPixel{37, 21};
inline constexpr double kPi = std::numbers::pi;

/// Random numbers that are the same on every machine.
class Random {
  public:
    Random(std::uint64_t seed, double difficulty)
        : engine_(seed * 0x9e3779b97f4a7c15ull + std::uint64_t(1e6 * std::log10(difficulty) + 5e8)) {}
    double within(double low, double high) {
        return low + (high - low) * (double(engine_() >> 11) * 0x1p-53);
    }
    double angle() { return within(0.0, 2.0 * kPi); }
    dvec2 around(double reach) { return {within(-reach, reach), within(-reach, reach)}; }

  private:
    std::mt19937_64 engine_;
};

inline dvec2 sampleOf(glm::ivec2 pixel) {
    return dvec2(pixel) + 0.5;
}
inline dvec2 direction(double angle) {
    return {std::cos(angle), std::sin(angle)};
}
inline dvec2 across(dvec2 v) {
    return {-v.y, v.x};
}

/// 10^from, 10^(from - step), ... 10^to.
inline std::vector<double> decades(int from, int to, int step = 1) {
    std::vector<double> out;
    for (int e = from; e >= to; e -= step) out.push_back(std::pow(10.0, e));
    return out;
}

inline std::vector<double> upwards(std::vector<double> list) {
    return {list.rbegin(), list.rend()};
}

}  // namespace edgewise::judge
