#include "analytic/exact/gauss_legendre.h"

#include <boost/math/constants/constants.hpp>
#include <map>
#include <mutex>

namespace edgewise::exact {
namespace {

/// P_n(x) and its derivative.
std::pair<Real, Real> legendre(int n, const Real& x) {
    Real before = 1, here = x;
    for (int k = 2; k <= n; ++k) {
        const Real next = ((2 * k - 1) * x * here - (k - 1) * before) / k;
        before = here, here = next;
    }
    return {here, n * (x * here - before) / (x * x - 1)};
}

GaussRule makeRule(int n) {
    GaussRule rule;
    for (int i = n; i >= 1; --i) {
        Real x = cos(boost::math::constants::pi<Real>() * (Real(i) - Real(0.25)) / (Real(n) + Real(0.5)));
        for (int step = 0; step < 12; ++step) {  // quadratic from two digits: six would do
            const auto [value, slope] = legendre(n, x);
            x -= value / slope;
        }
        const Real slope = legendre(n, x).second;
        rule.node.push_back(x);
        rule.weight.push_back(2 / ((1 - x * x) * slope * slope));
    }
    return rule;
}

}  // namespace

const GaussRule& gaussRule(int nodes) {
    static std::mutex mutex;
    static std::map<int, GaussRule> rules;
    const std::lock_guard lock(mutex);
    const auto known = rules.find(nodes);
    return known != rules.end() ? known->second : rules.emplace(nodes, makeRule(nodes)).first->second;
}

}  // namespace edgewise::exact
