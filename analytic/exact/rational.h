// Numbers of the oracle: rationals, and reals of 50 decimal digits.
#pragma once

#include <boost/multiprecision/gmp.hpp>
#include <boost/multiprecision/mpfr.hpp>

namespace edgewise::exact {

using Rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

/// 50 digits: twenty more than the oracle promises, for what cancels on the way.
using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<50>,
                                           boost::multiprecision::et_off>;

struct Point {
    Rational x, y;
};

}  // namespace edgewise::exact
