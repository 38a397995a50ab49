// How much of a sample an owner has.
#pragma once

#include <cstdint>

#include "analytic/screen_triangle.h"

namespace edgewise {

/// A weight in fixed point, 2^-60 a unit: sums are exact in any order.
using FixedWeight = std::int64_t;
inline constexpr int kWeightBits = 60;

struct OwnerWeight {
    Owner owner;
    FixedWeight weight;
};

}  // namespace edgewise
