// The 7/15 point Gauss-Kronrod rule in long double, with QUADPACK's error estimate.
#pragma once

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>

#include "tests/witness/wide.h"

namespace edgewise::witness {

/// Nodes on [-1, 1] with both weights; the Gauss weight is 0 at the nodes that only Kronrod uses.
struct KronrodRule {
    static constexpr int kNodes = 15;
    std::array<Real, kNodes> node{}, kronrod{}, gauss{};

    KronrodRule() {
        const auto& x = boost::math::quadrature::gauss_kronrod<Real, 15>::abscissa();
        const auto& wk = boost::math::quadrature::gauss_kronrod<Real, 15>::weights();
        const auto& wg = boost::math::quadrature::gauss<Real, 7>::weights();
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Real g = i % 2 == 0 ? wg[i / 2] : 0.0L;
            set(7 + i, x[i], wk[i], g);
            set(7 - i, -x[i], wk[i], g);
        }
    }

    static const KronrodRule& get() {
        static const KronrodRule rule;
        return rule;
    }

  private:
    void set(std::size_t at, Real x, Real k, Real g) {
        node[at] = x;
        kronrod[at] = k;
        gauss[at] = g;
    }
};

struct Estimate {
    Real value = 0, error = 0;
    Estimate& operator+=(const Estimate& other) {
        value += other.value;
        error += other.error;
        return *this;
    }
};

/// One application of the rule to values already taken at the nodes. QUADPACK's estimate (Piessens et al.
/// 1983, qk15): the distance of the two rules, sharpened where it is small against the integrand's variation,
/// never below rounding.
template <class ValueAt>
Estimate applyRule(ValueAt value_at, Real half_length) {
    const KronrodRule& rule = KronrodRule::get();
    Real kronrod = 0, gauss = 0, magnitude = 0, variation = 0;
    for (int i = 0; i < KronrodRule::kNodes; ++i) {
        const Real f = value_at(i);
        kronrod += rule.kronrod[i] * f;
        gauss += rule.gauss[i] * f;
        magnitude += rule.kronrod[i] * std::fabs(f);
    }
    for (int i = 0; i < KronrodRule::kNodes; ++i)
        variation += rule.kronrod[i] * std::fabs(value_at(i) - kronrod / 2);
    Real error = std::fabs(kronrod - gauss);
    if (variation > 0 && error > 0) {
        const Real ratio = 200 * error / variation;
        error = variation * std::min(1.0L, ratio * std::sqrt(ratio));
    }
    error = std::max(error, 16 * std::numeric_limits<Real>::epsilon() * magnitude);
    return {kronrod * half_length, error * half_length};
}

/// Integral of f over [a, b], halved until a part's estimate is below its share of `tolerance` or below 2^-40
/// of [a, b].
template <class Function>
Estimate integrate(const Function& f, Real a, Real b, Real tolerance, int depth = 40) {
    const KronrodRule& rule = KronrodRule::get();
    const Real middle = (a + b) / 2, half = (b - a) / 2;
    std::array<Real, KronrodRule::kNodes> value;
    Real magnitude = 0;
    for (int i = 0; i < KronrodRule::kNodes; ++i) {
        value[i] = f(middle + half * rule.node[i]);
        magnitude = std::max(magnitude, std::fabs(value[i]));
    }
    const Estimate whole = applyRule([&](int i) { return value[i]; }, half);
    const Real rounding = 64 * std::numeric_limits<Real>::epsilon() * magnitude * half;
    if (whole.error <= std::max(tolerance, rounding) || depth == 0) return whole;
    Estimate sum = integrate(f, a, middle, tolerance / 2, depth - 1);
    return sum += integrate(f, middle, b, tolerance / 2, depth - 1);
}

}  // namespace edgewise::witness
