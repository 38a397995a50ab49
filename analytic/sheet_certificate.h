// Cells that need no sweep. If every edge that meets a convex cell is used by exactly two of its triangles,
// in opposite directions, then each crossing of an edge leaves one triangle and enters one; if moreover one
// point of the cell lies in exactly one triangle, then every point does: the triangles are one sheet, and its
// edges are the visible segments.
#pragma once

#include <span>
#include <vector>

#include "analytic/cell_clip.h"
#include "analytic/shared_edges.h"

namespace edgewise {

class SheetCertificate {
  public:
    /// Emits the cell to `out` and returns true, or returns false and emits nothing. `shared` are the
    /// triangles' edges; all are opaque.
    bool run(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
             std::span<const std::uint32_t> triangles, const SharedEdges& shared, CellOutput& out);

  private:
    void emitEdge(const ScreenScene& scene, const CellFrame& frame, std::span<const std::uint32_t> triangles,
                  const SharedEdge& edge, CellOutput& out);
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
    std::vector<RowCrossing> crossings_;
};

}  // namespace edgewise
