// The lines that carry visible segments: edges of triangles, and lines where two depth planes are equal.
// Everything here is canonical: the same two lines give the same bits from every cell, thread and whole-pixel
// offset.
#pragma once

#include <compare>
#include <cstdint>

#include "analytic/fine_point.h"

namespace edgewise {

/// Names a carrier: edge `j - kFirstEdge` of ScreenTriangle i, or the line where planes i < j are equal.
struct LineRef {
    static constexpr std::uint32_t kFirstEdge = 0xfffffff0u;
    std::uint32_t i = 0, j = 0;

    static LineRef edge(std::uint32_t triangle, std::uint32_t k) { return {triangle, kFirstEdge + k}; }
    static LineRef depth(std::uint32_t p, std::uint32_t q) { return p < q ? LineRef{p, q} : LineRef{q, p}; }
    /// A horizontal that no line of the scene carries: see SlabSweep.
    static LineRef closing() { return {0xffffffffu, kFirstEdge - 1}; }
    bool isEdge() const { return j >= kFirstEdge; }
    bool isClosing() const { return *this == closing(); }
    auto operator<=>(const LineRef&) const = default;
};

/// A carrier's geometry. Edges run from a to b with a.y < b.y, or a.x > b.x if horizontal.
/// Depth lines are A (x - anchor.x) + B (y - anchor.y) + C = 0 with exact double-double coefficients.
struct Carrier {
    LineRef ref;
    glm::dvec2 a{0.0}, b{0.0};
    DoubleDouble A{}, B{}, C{};
    glm::dvec2 anchor{0.0};

    bool isEdge() const { return ref.isEdge(); }
    bool horizontal() const { return isEdge() ? a.y == b.y : A.hi == 0.0; }
    /// dx/dy; not for horizontal lines.
    double slope() const { return isEdge() ? (b.x - a.x) / (b.y - a.y) : -B.hi / A.hi; }
};

Carrier edgeCarrier(const ScreenScene& scene, LineRef ref);
Carrier depthCarrier(const ScreenScene& scene, LineRef ref);

/// The carrier's point at an ordinate (not for horizontal lines) or at an abscissa (not for vertical ones).
FinePoint pointAtY(const Carrier& line, FineCoordinate y);
FinePoint pointAtX(const Carrier& line, FineCoordinate x);

/// True where the carriers cross properly (for edges: inside both), with the point. Parallel lines do not
/// cross.
bool crossing(const Carrier& p, const Carrier& q, FinePoint& point);

/// The exact sign of cross(b - a, p - a) of points on the grid: 1 where p is inside of a triangle's edge a ->
/// b.
int sideOf(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p);

/// Whether two edges run between the same points.
inline bool sameEdge(const Carrier& p, const Carrier& q) {
    return p.a == q.a && p.b == q.b;
}

/// For sorting: equal for the same line wherever it was met.
std::uint64_t lineKey(const Carrier& line);

/// The line as the weights need it.
CarrierLine carrierLine(const Carrier& line);

/// The same for a closing horizontal through a point.
std::uint64_t closingKey(FineCoordinate y);
CarrierLine closingLine(const FinePoint& p);

}  // namespace edgewise
