// The visible map of a scene in exact arithmetic: the upper envelope of its triangles in depth, by CGAL.
#pragma once

#include <vector>

#include "analytic/exact/rational.h"
#include "analytic/screen_triangle.h"

namespace edgewise::exact {

/// A face of the map. Its boundary cycles are directed so that their signed areas in pixel coordinates
/// (x right, y down; cross > 0 is positive) sum to the face's own: the outer one is positive, holes are
/// negative.
struct Face {
    Owner owner = kBackground;
    std::vector<Owner> tied;  ///< all triangles that are nearest there, ascending; the owner is the first
    std::vector<std::vector<Point>> cycles;
    Point low, high;  ///< of all vertices
};

/// x0 <= x <= x1, y0 <= y <= y1 px.
struct Region {
    double x0, y0, x1, y1;
};

/// Whether the triangle's bounding box meets the region.
bool meets(const ScreenTriangle& triangle, const Region& region);

/// The faces that have an owner, of all triangles whose bounding boxes meet the region (faces are not cut to
/// it). What no face covers is the background's. The scene is opaque: panes are taken for opaque too. Pieces
/// of one owner are one surface each. Time grows about as n log n with the size of the map: 1000 triangles
/// take seconds.
std::vector<Face> visibleFaces(const ScreenScene& scene, const Region& region);

/// px^2.
Rational area(const Face& face);

}  // namespace edgewise::exact
