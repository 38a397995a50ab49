// A separable kernel's factor k and its integral K as piecewise polynomials, exact or fitted at construction.
#pragma once

#include <vector>

#include "analytic/gauss_legendre.h"
#include "analytic/prefilter.h"

namespace edgewise {

/// On interval i, with u = (x - centre[i]) * inverse_half[i] in [-1, 1]:
///     k(x) = sum_j k[i * k_count + j] u^j,    K(x) = int_-R^x k = sum_j K[i * (k_count + 1) + j] u^j. [E11]
struct KernelTable {
    std::vector<double> knot, centre, inverse_half;
    std::vector<double> k, K;
    int k_count = 0;         ///< coefficients an interval of k; K has one more
    double k_max = 0.0;      ///< sup |k|, per px
    double fit_error = 0.0;  ///< sup |fit - k| / sup |k|, measured at 64 points an interval
    double l1 = 0.0;         ///< int |k|, at least 1
    GaussRule rule;  ///< for a piece of a line inside one cell, K(x) k(y): exact or bounded by 2^-62 a cell
    int intervals() const { return static_cast<int>(centre.size()); }
};

KernelTable makeKernelTable(const Prefilter& filter);

/// k(x), per px; 0 outside [-R, R].
double kernelAt(const KernelTable& table, double x);

}  // namespace edgewise
