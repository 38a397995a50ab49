// Intervals of reals that hold every result of an expression, rounding included: each operation is widened by
// a unit of the last place to either side.
#pragma once

#include <limits>

#include "sdf/reals.h"

namespace edgewise::sdf {

struct Interval {
    double low = 0.0, high = 0.0;
    Interval() = default;
    explicit Interval(double x) : low(x), high(x) {}
    Interval(double l, double h) : low(l), high(h) {}
    bool holds(double x) const { return low <= x && x <= high; }
};

/// x and all that rounds to it.
inline Interval widened(double low, double high) {
    // |x| u + the smallest subnormal: one unit of the last place or more, at a tenth of nextafter's cost.
    constexpr double kUnit = 0x1p-52, kLeast = std::numeric_limits<double>::denorm_min();
    return {low - (std::abs(low) * kUnit + kLeast), high + (std::abs(high) * kUnit + kLeast)};
}
inline Interval operator+(const Interval& a, const Interval& b) {
    return widened(a.low + b.low, a.high + b.high);
}
inline Interval operator-(const Interval& a, const Interval& b) {
    return widened(a.low - b.high, a.high - b.low);
}
inline Interval operator-(const Interval& a) {
    return {-a.high, -a.low};
}
inline Interval operator*(const Interval& a, const Interval& b) {
    // Infinity times 0 is 0 here: the ends of unbounded intervals are limits.
    const auto product = [](double x, double y) { return x == 0.0 || y == 0.0 ? 0.0 : x * y; };
    const double p = product(a.low, b.low), q = product(a.low, b.high), r = product(a.high, b.low),
                 s = product(a.high, b.high);
    return widened(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
}
inline Interval operator/(const Interval& a, const Interval& b) {
    if (b.holds(0.0))
        return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    return a * widened(1.0 / b.high, 1.0 / b.low);
}
inline Interval abs(const Interval& a) {
    if (a.low >= 0.0) return a;
    return a.high <= 0.0 ? -a : Interval(0.0, std::max(-a.low, a.high));
}
inline Interval square(const Interval& a) {
    const Interval size = abs(a), result = widened(size.low * size.low, size.high * size.high);
    return {std::max(result.low, 0.0), result.high};
}
inline Interval sqrt(const Interval& a) {
    const Interval root = widened(std::sqrt(std::max(a.low, 0.0)), std::sqrt(std::max(a.high, 0.0)));
    return {std::max(root.low, 0.0), root.high};
}
inline Interval floor(const Interval& a) {
    return {std::floor(a.low), std::floor(a.high)};
}
inline Interval min(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::min(a.high, b.high)};
}
inline Interval max(const Interval& a, const Interval& b) {
    return {std::max(a.low, b.low), std::max(a.high, b.high)};
}
inline Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// Of a comparison of intervals.
enum class Truth : unsigned char { kNo, kYes, kEither };
inline Truth less(const Interval& a, const Interval& b) {
    if (a.high < b.low) return Truth::kYes;
    return a.low >= b.high ? Truth::kNo : Truth::kEither;
}
inline Interval choose(Truth condition, const Interval& a, const Interval& b) {
    if (condition == Truth::kEither) return hull(a, b);
    return condition == Truth::kYes ? a : b;
}

inline Interval cosine(const Interval& a) {
    constexpr double kPi = 3.14159265358979323846;
    // Multiples of pi between the ends, a little generously: even ones are maxima, odd ones minima.
    const double slack = 1e-12 * (1.0 + std::max(std::abs(a.low), std::abs(a.high)));
    const double first = std::ceil((a.low - slack) / kPi), last = std::floor((a.high + slack) / kPi);
    if (!(last - first < 1.0)) return {-1.0, 1.0};  // two extrema or more, or no number
    const double at_low = std::cos(a.low), at_high = std::cos(a.high);
    Interval result{std::min(at_low, at_high) - slack, std::max(at_low, at_high) + slack};
    if (first == last)
        (std::fmod(first, 2.0) == 0.0 ? result.high : result.low) = std::fmod(first, 2.0) == 0.0 ? 1.0 : -1.0;
    return {std::max(result.low, -1.0 - slack), std::min(result.high, 1.0 + slack)};
}
inline Interval sine(const Interval& a) {
    constexpr double kHalfPi = 1.57079632679489661923;
    return cosine(a - Interval(kHalfPi));
}

}  // namespace edgewise::sdf
