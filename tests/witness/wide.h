// Number types wider than double, for a judge whose own rounding must not matter.
#pragma once

namespace edgewise::witness {

using Real = long double;  ///< 64 bit mantissa on x86: sums and kernels
__extension__ typedef __float128
    Quad;  ///< 113 bit mantissa: lines and depth differences, rounded once to Real

}  // namespace edgewise::witness
