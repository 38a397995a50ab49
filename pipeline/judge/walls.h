// Straight walls between regions of the screen, in 113 bits, and where the regions' inner points are.
#pragma once

#include <functional>
#include <vector>

#include "analytic/exact/clipped_area.h"
#include "analytic/quad_real.h"
#include "analytic/visible_segment.h"

namespace edgewise::judge {

struct QuadPoint {
    QuadReal x = 0, y = 0;
};

/// grid + rest of a FinePoint has at most 97 bits: exact.
QuadPoint quadPoint(const FinePoint& p);
/// Rounded to 106 bits: 2^-86 px inside the guard band.
QuadPoint quadPoint(const exact::Point& p);
/// The nearest FinePoint, whose rest is a multiple of 2^-76 px.
FinePoint finePointNear(const QuadPoint& p);
exact::Point exactPoint(const FinePoint& p);

/// a.y <= b.y; `left` is at the left hand of a -> b on the screen's numbers turned so that it has smaller x.
struct Wall {
    QuadPoint a, b;
    Owner left = kBackground, right = kBackground;
    glm::dvec2 low{0.0}, high{0.0};  ///< its bounding box, off by the rounding to double
};

/// A wall from a to b as `left` sees it at smaller x when b.y > a.y: turned where b.y < a.y.
Wall wallBetween(const QuadPoint& a, const QuadPoint& b, Owner left, Owner right);

/// Where the wall is at an ordinate that it spans; it is not flat.
QuadReal abscissa(const Wall& wall, QuadReal y);

/// A piece between two neighbouring walls of the middle ordinate of a slab in which no wall begins, ends or
/// crosses a side of the box.
struct Chord {
    QuadReal y, x0, x1;  ///< cut to the box
    QuadReal widest;     ///< of the whole trapezoid: no chord in it is longer
    std::size_t index;   ///< how many walls are at its left
};

/// All chords of the box, slab by slab, from left to right; empty ones are left out.
void forChords(const std::vector<Wall>& walls, const exact::Region& box,
               const std::function<void(const Chord&)>& visit);

/// Whether no wall comes within `radius` px of the point.
bool clearOf(const std::vector<Wall>& walls, const QuadPoint& p, double radius);

/// x and y exchanged.
std::vector<Wall> exchanged(const std::vector<Wall>& walls);
exact::Region exchanged(const exact::Region& box);

}  // namespace edgewise::judge
