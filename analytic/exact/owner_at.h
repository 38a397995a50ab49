// The owner of a point of a scene, by asking every triangle: exact, and without an envelope.
#pragma once

#include "analytic/exact/rational.h"
#include "analytic/screen_triangle.h"

namespace edgewise::exact {

/// The nearest triangle that holds the point or has it on its border, the lowest index where depths are
/// equal; the background where there is none. Panes are taken for opaque, as in visibleFaces().
Owner ownerAt(const ScreenScene& scene, const Point& p);

}  // namespace edgewise::exact
