// The lines of a leaf: edges and lines of equal depth, clipped to the cell, with the events where they meet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analytic/cell.h"
#include "analytic/local_plane.h"

namespace edgewise {

/// A line that is not horizontal. Between the ordinates in0 and in1 it runs inside the cell, from `enter` to `exit`;
/// between y0 and in0 it runs beside it on side_before, between in1 and y1 on side_after (-1 left, +1 right).
struct LeafLine {
    Carrier carrier;
    OrderKey y0, y1, in0, in1;
    int side_before = 0, side_after = 0;
    FinePoint enter, exit;
    double slope = 0.0;              ///< dx/dy
    double x_low = 0.0, x_high = 0.0;  ///< from the cell's origin, over the part inside

    bool runsInside() const { return in0 < in1; }
};

/// A horizontal edge or line of equal depth, clipped to the cell: from x_low to x_high from the origin.
struct LeafHorizontal {
    Carrier carrier;
    OrderKey key;
    FineCoordinate y;
    FinePoint low, high;
    double x_low, x_high;
};

/// Two lines meet.
struct LeafEvent {
    OrderKey key;
    std::uint32_t p, q;
    FinePoint point;
};

/// Collects the lines of one leaf. A row of `words` 64-bit words a line says which triangles it bounds.
class LeafLines {
  public:
    void collect(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
                 std::span<const std::uint32_t> triangles, const VisibilityOptions& options,
                 VisibilityCounts& counts);

    std::vector<LocalPlane> planes;  ///< one a triangle
    std::vector<LeafLine> lines;
    std::vector<LeafHorizontal> horizontals;  ///< sorted by key
    std::vector<LeafEvent> events;            ///< sorted by key
    std::vector<OrderKey> keys;               ///< of all events, ends and borders, ascending, distinct
    std::vector<FineCoordinate> ordinates;    ///< one a key
    std::vector<std::uint64_t> masks;
    std::size_t words = 1;
    OrderKey top = 0, bottom = 0;

    double localX(const FinePoint& p) const { return (p.grid.x - origin_.x) + p.rest.x; }
    /// Abscissa of a line at an ordinate, from the origin.
    double xAt(const LeafLine& line, FineCoordinate y) const {
        const double dy = (y.grid - line.enter.grid.y) + (y.rest - line.enter.rest.y);
        return localX(line.enter) + dy * line.slope;
    }

  private:
    void addEdge(const ScreenScene& scene, std::uint32_t triangle, std::uint32_t edge, std::size_t bit);
    void addHorizontal(const Carrier& carrier, FineCoordinate y, FinePoint low, FinePoint high);
    void addDepthLines(const ScreenScene& scene, std::span<const std::uint32_t> triangles, VisibilityCounts& counts);
    void addDepthLine(const ScreenScene& scene, const ScreenTriangle& p, const ScreenTriangle& q);
    bool clipSides(LeafLine& line, int region_a, int region_b);
    void addCrossings();
    void addKey(OrderKey key, FineCoordinate y);
    void sortKeys();

    Cell cell_;
    glm::dvec2 origin_{0.0};
    std::vector<std::pair<OrderKey, FineCoordinate>> key_scratch_;
};

}  // namespace edgewise
