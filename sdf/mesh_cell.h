// How the surface passes a cell: closed loops over its faces, from the signs at its corners.
#pragma once

#include <array>
#include <cstdint>

namespace edgewise::sdf {

// Corner c is at (c & 1, c >> 1 & 1, c >> 2). Edge 4 a + u + 2 v runs along axis a, at u and v along the next
// two axes in cyclic order. Face 2 a + s is the one at s along axis a.
inline constexpr int kCellCorners = 8, kCellEdges = 12, kCellFaces = 6;

struct EdgeEnds {
    int axis, low, high;  ///< corners
};
constexpr EdgeEnds edgeEnds(int edge) {
    const int axis = edge / 4, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int low = (edge & 1) << u | (edge >> 1 & 1) << v;
    return {axis, low, low | 1 << axis};
}
constexpr int edgeBetween(int a, int b) {
    for (int edge = 0; edge < kCellEdges; ++edge) {
        const EdgeEnds ends = edgeEnds(edge);
        if ((ends.low == a && ends.high == b) || (ends.low == b && ends.high == a)) return edge;
    }
    return -1;
}
/// Counter-clockwise, seen from outside the cell.
constexpr std::array<int, 4> faceCorners(int face) {
    const int axis = face / 2, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, at = (face & 1) << axis;
    if (face & 1) return {at, at | u, at | u | v, at | v};
    return {at, at | v, at | u | v, at | u};
}

/// The loops of a cell. The edge that follows another in its loop shares a face with it; seen from
/// outside the surface they go clockwise.
struct CellLoops {
    int count = 0;
    std::array<std::int8_t, kCellEdges> loop;   ///< an edge's; -1: the surface does not cross it
    std::array<std::int8_t, kCellEdges> next;   ///< the edge after it
    std::array<std::int8_t, kCellEdges> first;  ///< a loop's lowest edge
};

/// `values`: at the corners; inside is below 0. Where a face has two inside corners across, the sign at the
/// saddle of its bilinear interpolation tells whether they are joined (the asymptotic decider of Nielson and
/// Hamann 1991): by the face's values alone, so that its two cells agree.
CellLoops loopsOf(const double (&values)[kCellCorners]);

}  // namespace edgewise::sdf
