// Who owns the support's border when nothing crosses it, though a segment touches the point where the caller
// looked.
#pragma once

#include <cstdint>

#include "analytic/visible_segment.h"

namespace edgewise {

/// The caller names the owner at B = (sample.x + R, sample.y). That is a matter of rounding where a segment
/// passes B within a few units of its coordinates, and the wrong side of B for a line that touches the
/// support's disk there. The nearest such segment knows better: the side of it on which the border lies
/// follows from the same tests of its ends that decide about crossings. [E15]
struct BasePoint {
    double distance2 = 1e300;  ///< from B, px^2
    double cosine =
        -2.0;  ///< of the segment's angle at its nearest point with the way to the border: nearer wins
    Owner owner = kBackground;
    bool known() const { return distance2 < 1e300; }
};

/// Takes the segment into account; the result does not depend on the order of the calls.
void considerBase(BasePoint& base, bool radial, double radius, glm::dvec2 sample,
                  const VisibleSegment& segment, const CarrierLine& line, Owner left, Owner right);

}  // namespace edgewise
