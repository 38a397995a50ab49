// The ordinates where the picture inside a support, cut by horizontal lines, changes its kind.
#pragma once

#include <vector>

#include "tests/witness/kernels.h"
#include "tests/witness/local_scene.h"

namespace edgewise::witness {

/// Ascending, from -radius to radius. Between two neighbours the order of the visible boundaries, of the
/// kernel's knots and of the support's border along x stays as it is, so every owner's integral is a smooth
/// function of v there. Rounding may misplace one by 1e-18 px: the adaptive outer integral sees the kink and
/// pays for it.
std::vector<Real> eventOrdinates(const LocalScene& scene, const Kernel& kernel);

}  // namespace edgewise::witness
