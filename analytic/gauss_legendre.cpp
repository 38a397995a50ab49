#include "analytic/gauss_legendre.h"

#include <cmath>
#include <stdexcept>

#include "analytic/quad_real.h"

namespace edgewise {
namespace {

struct Legendre {
    QuadReal value, derivative;
};

Legendre legendre(int n, QuadReal x) {
    QuadReal p0 = 1, p1 = x;
    for (int k = 2; k <= n; ++k) {
        const QuadReal p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
    }
    return {p1, n * (x * p1 - p0) / (x * x - 1)};
}

}  // namespace

GaussRule gaussRule(int count) {
    GaussRule rule;
    for (int i = 0; i < count; ++i) {
        QuadReal x = -std::cos(M_PI * (i + 0.75) / (count + 0.5));
        if (2 * i + 1 == count) x = 0;
        for (int step = 0; step < 6; ++step) {
            const Legendre p = legendre(count, x);
            x -= p.value / p.derivative;
        }
        const QuadReal slope = legendre(count, x).derivative;
        rule.node.push_back(static_cast<double>((1 + x) / 2));
        rule.weight.push_back(static_cast<double>(1 / ((1 - x * x) * slope * slope)));
    }
    return rule;
}

int nodesNeeded(const std::function<double(double)>& growth, double length, double target) {
    for (int n = 1; n <= 64; ++n) {
        for (double rho = 1.25; rho < 1e4; rho *= 1.05) {
            const double bound = growth(length / 4 * (rho - 1 / rho));
            if (32.0 / 15.0 * bound * std::pow(rho, -2 * n) / (1 - 1 / (rho * rho)) <= target) return n;
        }
    }
    throw std::logic_error("nodesNeeded: more than 64 nodes");
}

}  // namespace edgewise
