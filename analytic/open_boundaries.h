// Whether a map's owners have closed boundaries.
#pragma once

#include <cstddef>

#include "analytic/visibility.h"

namespace edgewise {

/// Owners whose segments, taken as a walk around each, end where none begins, but for the borders of
/// `window`, which the map was made for. Ends are compared bit for bit. O(segments).
std::size_t openBoundaries(const VisibleMap& map, const Window& window);

}  // namespace edgewise
