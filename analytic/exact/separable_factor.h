// One axis of a separable kernel, k(x), and its integral K(x) from -R, to 45 digits or better.
#pragma once

#include <vector>

#include "analytic/exact/rational.h"
#include "analytic/prefilter.h"

namespace edgewise::exact {

/// k is written from the contract's table alone and normalised by its own integral. Between knots it is held
/// as a Chebyshev series whose last coefficients are checked to vanish.
class SeparableFactor {
  public:
    /// For separable kernels.
    explicit SeparableFactor(const Prefilter& filter);

    const Real& radius() const { return radius_; }
    /// Where the series change: -R first, R last.
    const std::vector<Real>& knots() const { return knots_; }
    /// k and K at x in interval i of the knots.
    Real density(std::size_t i, const Real& x) const;
    Real mass(std::size_t i, const Real& x) const;
    /// The interval that holds x, for -R <= x <= R.
    std::size_t intervalOf(const Real& x) const;
    /// Bound of what the series leave out.
    const Real& error() const { return error_; }

  private:
    struct Series {
        std::vector<Real> density,
            mass;     ///< Chebyshev coefficients over the interval; mass from its left end
        Real before;  ///< K at its left end
    };
    Real evaluate(const std::vector<Real>& series, std::size_t i, const Real& x) const;

    Real radius_, error_ = 0;
    std::vector<Real> knots_;
    std::vector<Series> series_;
};

}  // namespace edgewise::exact
