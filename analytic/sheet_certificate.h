// Cells that need no sweep. If every edge that meets a convex cell is used by exactly two of its triangles,
// in opposite directions, then each crossing of an edge leaves one triangle and enters one; if moreover one
// point of the cell lies in exactly one triangle, then every point does: the triangles are one sheet, and its
// edges are the visible segments.
#pragma once

#include <span>
#include <vector>

#include "analytic/row_crossings.h"
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

    RowCrossings crossings_;
};

}  // namespace edgewise
