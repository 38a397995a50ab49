// Who owns how much of the support's border, from the labels of the crossings with it alone. [E12], [E13]
#pragma once

#include <cstdint>
#include <vector>

#include "analytic/screen_triangle.h"

namespace edgewise {

/// A visible segment crosses the border: along it the owner changes from `before` to `after`. `position` is
/// the border's integral up to here in fixed point, the whole is 2^60; it is not monotone where a kernel has
/// negative lobes, so crossings are sorted by `order`, which rounding may have moved by `doubt`; `spread`
/// sorts those of segments that part at one vertex.
struct BorderCrossing {
    double order;
    std::int64_t position;
    double doubt;
    double spread;
    Owner before, after;
    double reaches_back = 0.0;  ///< scratch of shareBorder
};

/// A stretch of the border.
struct BorderShare {
    Owner owner;
    std::int64_t share;
};

/// Shares of the border that sum to exactly 2^60. Only the owner before the first crossing is a question of
/// their order; crossings nearer to each other than their doubt are asked for it together, since rounding may
/// have swapped them. `circle`: the border closes, order is in turns in (-1/2, 1/2] and so is the position;
/// otherwise that runs from 0 to 2^60. Sorts `crossings`; the result does not depend on their order. Returns
/// 1 where labels are not left as often as they are entered: the map is open there. Else 0.
int shareBorder(std::vector<BorderCrossing>& crossings, bool circle, Owner base,
                std::vector<BorderShare>& shares);

}  // namespace edgewise
