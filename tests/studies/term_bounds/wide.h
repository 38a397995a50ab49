// Reals of about 106 bits for the screen, with the few functions that it needs: double-double arithmetic,
// tables made from 50 digits.
#pragma once

#include "analytic/double_double.h"
#include "analytic/exact/rational.h"

namespace edgewise::study {

/// hi + lo, unevaluated.
struct Wide {
    f64::dd v{0.0, 0.0};

    Wide() = default;
    Wide(double x) : v{x, 0.0} {}
    explicit Wide(f64::dd x) : v(x) {}
    explicit operator double() const { return v.hi; }
};

inline Wide operator+(Wide a, Wide b) {
    return Wide(f64::ddAdd(a.v, b.v));
}
inline Wide operator-(Wide a) {
    return Wide(f64::ddNeg(a.v));
}
inline Wide operator-(Wide a, Wide b) {
    return a + -b;
}
inline Wide operator*(Wide a, Wide b) {
    return Wide(f64::ddMul(a.v, b.v));
}
inline Wide operator/(Wide a, Wide b) {
    return Wide(f64::ddDiv(a.v, b.v));
}
inline Wide& operator+=(Wide& a, Wide b) {
    return a = a + b;
}
inline bool operator<(Wide a, Wide b) {
    return a.v.hi < b.v.hi || (a.v.hi == b.v.hi && a.v.lo < b.v.lo);
}
inline bool operator>(Wide a, Wide b) {
    return b < a;
}
inline Wide abs(Wide a) {
    return a.v.hi < 0 ? -a : a;
}

/// a b and a - b of doubles, exact.
inline Wide exactProduct(double a, double b) {
    return Wide(f64::twoProd(a, b));
}
inline Wide exactDifference(double a, double b) {
    return Wide(f64::twoSum(a, -b));
}

/// The nearest Wide of a number of 50 digits, and of a 64-bit integer.
Wide wideFrom(const exact::Real& x);
Wide wideFrom(std::int64_t n);

/// Relative errors below 2^-90, or absolute ones below 2^-95 where the result passes through 0.
Wide sqrt(Wide x);             ///< 0 for x <= 0
Wide exp(Wide x);              ///< -100 <= x <= 1
Wide onePhi(Wide v);           ///< (1 - e^-v)/v, 0 <= v <= 100
Wide log(Wide x);              ///< x > 0
Wide turnsOf(Wide y, Wide x);  ///< the angle of (x, y) over 2 pi, [-1/2, 1/2]; 0 at (0, 0)
Wide polynomial(const std::vector<Wide>& c, Wide x);

}  // namespace edgewise::study
