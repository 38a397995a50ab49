// Gauss-Legendre rules on [0, 1], and how many nodes an analytic integrand needs, proven.
#pragma once

#include <functional>
#include <vector>

namespace edgewise {

/// sum of weight[i] f(node[i]) is the mean of f over [0, 1], exact for polynomials of degree 2n - 1.
struct GaussRule {
    std::vector<double> node, weight;
    int count() const { return static_cast<int>(node.size()); }
};

/// Nodes and weights correctly rounded from 113 bits.
GaussRule gaussRule(int count);

/// The smallest count whose mean over a real interval of length `length` errs by at most `target`, by the
/// bound
///     |error of the mean| <= (32/15) M(rho) rho^-2n / (1 - rho^-2)                                      [E9]
/// (Trefethen, Approximation Theory and Practice, theorem 19.3), M(rho) = growth(imaginary half axis of the
/// Bernstein ellipse), the best rho of a ladder. growth(y) bounds |f| wherever |Im z| <= y.
int nodesNeeded(const std::function<double(double)>& growth, double length, double target);

}  // namespace edgewise
