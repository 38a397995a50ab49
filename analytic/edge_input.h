// A visible segment as its terms take it.
#pragma once

#include "analytic/lane_kernel.h"
#include "analytic/visible_segment.h"

namespace edgewise {

inline EdgeInput edgeInput(const VisibleSegment& s, const CarrierLine& l) {
    return {s.a.grid.x, s.a.grid.y, s.a.rest.x, s.a.rest.y, s.b.grid.x,    s.b.grid.y,   s.b.rest.x,
            s.b.rest.y, s.length,   l.origin.x, l.origin.y, l.nx_hi,       l.nx_lo,      l.ny_hi,
            l.ny_lo,    l.c_hi,     l.c_lo,     l.length,   l.direction.x, l.direction.y};
}

}  // namespace edgewise
