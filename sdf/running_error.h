// A value with a bound of what float arithmetic may be off from it: running error analysis (Wilkinson).
// Evaluating a tape with these derives how far the GLSL and the C++ float evaluators may be from the double
// one at a point.
#pragma once

#include "sdf/reals.h"

namespace edgewise::sdf {

/// Half a unit of the last place, of which every + - * of float makes one at most.
inline constexpr double kFloatRounding = 0x1p-24;
/// Vulkan grants a quotient 2.5 units of the last place and a square root what 1/inversesqrt has: 2 units for
/// inversesqrt, 2.5 for the quotient; in roundings.
inline constexpr double kFloatQuotientRoundings = 5.0, kFloatRootRoundings = 9.0;

struct RunningError {
    double value = 0.0;
    double error = 0.0;  ///< |what float arithmetic makes of it - value| is at most this
    RunningError() = default;
    /// A number of the scene: rounded to float.
    explicit RunningError(double v)
        : value(v), error(static_cast<float>(v) == v ? 0.0 : std::abs(v) * kFloatRounding) {}
    RunningError(double v, double e) : value(v), error(e) {}
    /// Sums with it and products of it are not rounded.
    bool isZero() const { return value == 0.0 && error == 0.0; }
};

/// `roundings` of a result, on top of what its arguments bring. 2^-126: what may be flushed to 0.
inline RunningError rounded(double value, double error, double roundings) {
    return {value, error + roundings * kFloatRounding * (std::abs(value) + error) * 1.0000001 + 0x1p-126};
}
inline RunningError operator+(const RunningError& a, const RunningError& b) {
    if (a.isZero() || b.isZero()) return a.isZero() ? b : a;
    return rounded(a.value + b.value, a.error + b.error, 1.0);
}
inline RunningError operator-(const RunningError& a, const RunningError& b) {
    if (b.isZero()) return a;
    return rounded(a.value - b.value, a.error + b.error, 1.0);
}
inline RunningError operator-(const RunningError& a) {
    return {-a.value, a.error};
}
inline RunningError operator*(const RunningError& a, const RunningError& b) {
    if (a.isZero() || b.isZero()) return {};
    return rounded(a.value * b.value,
                   std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error, 1.0);
}
inline RunningError operator/(const RunningError& a, const RunningError& b) {
    const double smallest = std::abs(b.value) - b.error;
    if (!(smallest > 0.0)) return {a.value / b.value, INFINITY};
    const double quotient = a.value / b.value;
    return rounded(quotient, (a.error + std::abs(quotient) * b.error) / smallest, kFloatQuotientRoundings);
}
inline RunningError square(const RunningError& a) {
    return a * a;
}
inline RunningError sqrt(const RunningError& a) {
    const double root = std::sqrt(std::max(a.value, 0.0));
    // |sqrt(x) - sqrt(y)| is at most sqrt|x - y| and at most |x - y| / (sqrt(x) + sqrt(y)).
    const double by_root = std::sqrt(a.error);
    return rounded(root, root > by_root ? a.error / root : by_root, kFloatRootRoundings);
}
inline RunningError abs(const RunningError& a) {
    return {std::abs(a.value), a.error};
}
/// A cell's number may come out one off where the argument is near a whole number.
inline RunningError floor(const RunningError& a) {
    const double whole = std::floor(a.value);
    const bool sure = std::floor(a.value - a.error) == whole && std::floor(a.value + a.error) == whole;
    return {whole, sure ? 0.0 : 1.0 + std::ceil(a.error)};
}
inline RunningError min(const RunningError& a, const RunningError& b) {
    if (a.value + a.error < b.value - b.error) return a;
    if (b.value + b.error < a.value - a.error) return b;
    return {std::min(a.value, b.value), std::max(a.error, b.error)};
}
inline RunningError max(const RunningError& a, const RunningError& b) {
    if (a.value - a.error > b.value + b.error) return a;
    if (b.value - b.error > a.value + a.error) return b;
    return {std::max(a.value, b.value), std::max(a.error, b.error)};
}

struct UnsureTruth {
    bool value, sure;
};
inline UnsureTruth less(const RunningError& a, const RunningError& b) {
    const double errors = a.error + b.error;
    return {a.value < b.value, errors == 0.0 || std::abs(a.value - b.value) > errors};
}
inline RunningError choose(UnsureTruth condition, const RunningError& a, const RunningError& b) {
    const RunningError &taken = condition.value ? a : b, &other = condition.value ? b : a;
    if (condition.sure) return taken;
    return {taken.value, std::max(taken.error, std::abs(other.value - taken.value) + other.error)};
}
/// sdf_sine.glsl's steps: the argument's multiple of pi is taken off in three products and sums, the series
/// adds under 8 roundings of at most 1.
inline RunningError sine(const RunningError& a) {
    const double reduction = 4.0 * kFloatRounding * (1.0 + std::abs(a.value) + a.error);
    return {sine(a.value), std::min(2.0, a.error + reduction + 8.0 * kFloatRounding)};
}
inline RunningError cosine(const RunningError& a) {
    const RunningError shifted = a + RunningError(1.57079632679489661923);
    return {cosine(a.value), sine(shifted).error};
}

}  // namespace edgewise::sdf
