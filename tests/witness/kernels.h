// The judge's own kernels, written from the table "Filters" of the contract and normalised by nobody's
// formula.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analytic/prefilter.h"
#include "tests/witness/wide.h"

namespace edgewise::witness {

struct Kernel {
    std::string name;
    bool disk = false;        ///< support: the disk r < radius, or the square [-radius, radius]^2
    Real radius = 1;          ///< px
    std::vector<Real> knots;  ///< where a square kernel is not smooth inside, along either axis
    bool apex = false;        ///< not smooth at the sample itself
    std::function<Real(Real x, Real y)> shape;  ///< the table's formula inside the support, not normalised
};

/// The kernel that `filter` names: only its parameters are read, none of its functions is called.
Kernel kernelLike(const Prefilter& filter);

/// The eleven kernels of the contract with their defaults; `poly` as (1 - (r/R)^2)^2.
std::vector<Prefilter> allPrefilters();

}  // namespace edgewise::witness
