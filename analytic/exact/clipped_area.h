// Areas within a box, in rationals.
#pragma once

#include "analytic/exact/visible_faces.h"

namespace edgewise::exact {

struct Box {
    Point low, high;
};

/// int clamp(x - low.x, 0, high.x - low.x) dy from a to b, y within the box: what the directed edge adds to
/// the area that lies within the box at the smaller x of it.
Rational clampedArea(Point a, Point b, const Box& box);

/// px^2.
Rational areaWithin(const Face& face, const Box& box);

}  // namespace edgewise::exact
