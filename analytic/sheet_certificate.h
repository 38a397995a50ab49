// Cells that need no sweep. If every edge that meets a convex cell is used by exactly two of its triangles,
// in opposite directions, then each crossing of an edge leaves one triangle and enters one; if moreover one
// point of the cell lies in exactly one triangle, then every point does: the triangles are one sheet, and its
// edges are the visible segments.
#pragma once

#include <span>
#include <vector>

#include "analytic/cell_clip.h"

namespace edgewise {

class SheetCertificate {
  public:
    /// Emits the cell to `out` and returns true, or returns false and emits nothing.
    bool run(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
             std::span<const std::uint32_t> triangles, CellOutput& out);

  private:
    /// An edge between two triangles of the list; `canonical` runs along the carrier's direction.
    struct SharedEdge {
        std::uint64_t ends;  ///< the vertex ids, the smaller one first
        LineRef canonical;
        std::uint32_t with = kUnused,
                      against = kUnused;  ///< the triangle whose boundary runs so, and the other
        static constexpr std::uint32_t kUnused = 0xffffffffu;
    };
    bool pairEdges(const ScreenScene& scene, const Cell& cell, std::span<const std::uint32_t> triangles);
    bool enter(const ScreenScene& scene, std::uint32_t triangle, std::uint32_t k);
    void emitEdge(const ScreenScene& scene, const CellFrame& frame, const SharedEdge& edge, CellOutput& out);
    bool sortRows();
    void emitRows(const ScreenScene& scene, const CellFrame& frame, std::span<const std::uint32_t> triangles,
                  CellOutput& out);

    /// A row meets a non-horizontal edge at x; right of it lies `after`. Edges that leave one point on the
    /// row are in the order in which the scanline just below meets them: by slope.
    struct RowCrossing {
        int row;
        double x, slope;
        Owner before, after;
    };
    std::vector<SharedEdge> edges_;
    std::vector<std::uint32_t> slots_;
    std::vector<RowCrossing> crossings_;
};

}  // namespace edgewise
