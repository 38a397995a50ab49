// The one predicate of visibility that must be exact: which of two depth planes is nearer at a point.
#pragma once

#include "analytic/double_double.h"
#include "analytic/screen_triangle.h"

namespace edgewise {

/// The sign of p(x, y) - q(x, y) at the offset (dx, dy) px from the scene's anchor: 1 where p is nearer, 0
/// where they are equal. Exact for all finite inputs whose products neither overflow nor fall below 2^-960.
int depthDifferenceSign(const DepthPlane& p, const DepthPlane& q, double dx, double dy);
int depthDifferenceSign(const DepthPlane& p, const DepthPlane& q, f64::dd dx, f64::dd dy);

}  // namespace edgewise
