// Gauss-Legendre rules of 50 digits.
#pragma once

#include <vector>

#include "analytic/exact/rational.h"

namespace edgewise::exact {

/// Nodes in (-1, 1) and weights that sum to 2; exact for polynomials of degree 2 n - 1. Made once a size, by
/// Newton's method on the Legendre polynomial.
struct GaussRule {
    std::vector<Real> node, weight;
};
const GaussRule& gaussRule(int nodes);

/// The integral of f over [a, b] by one rule.
template <class Function>
Real gaussIntegral(const GaussRule& rule, const Real& a, const Real& b, const Function& f) {
    const Real middle = (a + b) / 2, half = (b - a) / 2;
    Real sum = 0;
    for (std::size_t i = 0; i < rule.node.size(); ++i)
        sum += rule.weight[i] * f(middle + half * rule.node[i]);
    return sum * half;
}

}  // namespace edgewise::exact
