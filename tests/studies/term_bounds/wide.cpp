#include "tests/studies/term_bounds/wide.h"

#include <boost/math/constants/constants.hpp>
#include <cmath>

namespace edgewise::study {
namespace {

using exact::Real;

constexpr int kStepsPerUnit = 16;  // of the table of exponentials: remainders of 1/32
constexpr int kLowest = -100 * kStepsPerUnit, kHighest = 2 * kStepsPerUnit;
constexpr int kExpTerms = 14;    // (1/32)^14/14! < 2^-106
constexpr int kAngleSteps = 64;  // a radian: remainders of 1/128
constexpr int kAtanTerms = 8;    // (1/127)^17/17 < 2^-122

/// sum of r^k / k! over k >= 0, or of (-r)^k/(k + 1)!.
std::vector<Wide> factorialSeries(int shift, int sign) {
    std::vector<Wide> c;
    Real factorial = 1;
    for (int k = 0; k <= kExpTerms + shift; ++k) {
        if (k > 0) factorial *= k;
        if (k >= shift)
            c.push_back(wideFrom(Real((k - shift) % 2 == 0 || sign > 0 ? 1 / factorial : -1 / factorial)));
    }
    return c;
}

const std::vector<Wide>& exponentials() {
    static const std::vector<Wide> table = [] {
        std::vector<Wide> out;
        for (int j = kLowest; j <= kHighest; ++j) out.push_back(wideFrom(Real(exp(Real(j) / kStepsPerUnit))));
        return out;
    }();
    return table;
}

struct Direction {
    Wide cosine, sine, turns;
};

Direction directionAt(int j) {
    const Real angle = Real(j) / kAngleSteps;
    const Real turns = angle / (2 * boost::math::constants::pi<Real>());
    return {wideFrom(Real(cos(angle))), wideFrom(Real(sin(angle))), wideFrom(turns)};
}

constexpr int kMostSteps = 202;  // beyond pi

const Direction& direction(int j) {
    static const std::vector<Direction> table = [] {
        std::vector<Direction> out;
        for (int i = -kMostSteps; i <= kMostSteps; ++i) out.push_back(directionAt(i));
        return out;
    }();
    return table[static_cast<std::size_t>(j + kMostSteps)];
}

/// atan(q)/q over q^2, in turns.
const std::vector<Wide>& atanSeries() {
    static const std::vector<Wide> c = [] {
        std::vector<Wide> out;
        for (int k = 0; k <= kAtanTerms; ++k)
            out.push_back(
                wideFrom(Real((k % 2 ? -1 : 1) / (2 * boost::math::constants::pi<Real>() * (2 * k + 1)))));
        return out;
    }();
    return c;
}

}  // namespace

Wide wideFrom(const Real& x) {
    const double hi = static_cast<double>(x);
    return Wide(f64::twoSum(hi, static_cast<double>(Real(x - hi))));
}

Wide wideFrom(std::int64_t n) {
    const std::int64_t low = n % (std::int64_t(1) << 31);
    return Wide(f64::twoSum(static_cast<double>(n - low), static_cast<double>(low)));
}

Wide polynomial(const std::vector<Wide>& c, Wide x) {
    Wide sum = c.back();
    for (std::size_t k = c.size() - 1; k-- > 0;) sum = sum * x + c[k];
    return sum;
}

// One step of Newton's method doubles the digits.
Wide sqrt(Wide x) {
    if (!(x.v.hi > 0)) return 0.0;
    const Wide root = std::sqrt(x.v.hi);
    return (root + x / root) * 0.5;
}

Wide exp(Wide x) {
    static const std::vector<Wide> series = factorialSeries(0, 1);
    const double step = std::nearbyint(x.v.hi * kStepsPerUnit);
    const Wide rest = x - Wide(step / kStepsPerUnit);
    return exponentials().at(static_cast<std::size_t>(step - kLowest)) * polynomial(series, rest);
}

Wide onePhi(Wide v) {
    static const std::vector<Wide> series = factorialSeries(1, -1);
    if (v.v.hi < 1.0 / 32) return polynomial(series, v);
    return (1.0 - exp(-v)) / v;
}

// log x = y + log(x e^-y), y the double nearest: the last factor is 1 + d, d about 2^-53, d^3 < 2^-156.
Wide log(Wide x) {
    const int k = std::ilogb(x.v.hi);
    const Wide m(f64::dd{std::ldexp(x.v.hi, -k), std::ldexp(x.v.lo, -k)});
    const double y = std::log(m.v.hi);
    const Wide d = m * exp(Wide(-y)) - 1.0;
    static const Wide ln2 = wideFrom(boost::math::constants::ln_two<Real>());
    return ln2 * Wide(double(k)) + (Wide(y) + (d - d * d * 0.5));
}

// Turned back by a multiple of 1/64 rad, what is left is small.
Wide turnsOf(Wide y, Wide x) {
    if (x.v.hi == 0 && y.v.hi == 0) return 0.0;
    const Direction& d =
        direction(static_cast<int>(std::nearbyint(std::atan2(y.v.hi, x.v.hi) * kAngleSteps)));
    const Wide q = (y * d.cosine - x * d.sine) / (x * d.cosine + y * d.sine);
    return d.turns + q * polynomial(atanSeries(), q * q);
}

}  // namespace edgewise::study
