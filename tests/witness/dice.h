// Random numbers that are the same on every machine: the standard's distributions are not.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <numbers>
#include <random>

namespace edgewise::witness {

class Dice {
  public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double uniform(double lo, double hi) { return lo + (hi - lo) * (double(engine_() >> 11) * 0x1p-53); }
    int integer(int lo, int hi) { return lo + int(engine_() % std::uint64_t(hi - lo + 1)); }
    bool coin() { return engine_() & 1; }
    double angle() { return uniform(0, 2 * std::numbers::pi); }
    /// 10^uniform: all magnitudes alike.
    double magnitude(double log10_lo, double log10_hi) { return std::pow(10.0, uniform(log10_lo, log10_hi)); }
    glm::dvec2 around(glm::dvec2 centre, double radius) {
        const double x = uniform(-radius, radius), y = uniform(-radius, radius);
        return {centre.x + x, centre.y + y};
    }

  private:
    std::mt19937_64 engine_;
};

inline glm::dvec2 unitVector(double angle) {
    return {std::cos(angle), std::sin(angle)};
}

}  // namespace edgewise::witness
