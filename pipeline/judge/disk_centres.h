// Where the middle of a disk in a face of the oracle can be, in rationals.
#pragma once

#include <vector>

#include "analytic/exact/visible_faces.h"

namespace edgewise::judge {

struct DiskCentres {
    std::vector<exact::Point> corners;  ///< of a convex region
    bool convex_face = false;           ///< the face lies on one hand of each of its sides
};

/// The region holds the middle of every disk of this radius that lies in the face and has its middle in the
/// box: it is what the box keeps where each side with the whole face on one hand is moved inwards by the
/// radius. Empty, it proves that there is no such disk. The sides' lengths are rounded down to double, so the
/// region of a convex face holds the middles of slightly smaller disks too, and nothing else.
DiskCentres diskCentres(const exact::Face& face, const exact::Region& box, double radius_px);

/// The mean of the corners of a region that is not empty.
exact::Point meanOf(const std::vector<exact::Point>& corners);

}  // namespace edgewise::judge
