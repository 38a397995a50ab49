// Visibility of a cell: drop what is hidden, split what is crowded, sweep the rest.
#pragma once

#include <span>
#include <vector>

#include "analytic/cell.h"
#include "analytic/edge_visibility.h"
#include "analytic/sheet_certificate.h"
#include "analytic/sheet_occlusion.h"
#include "analytic/slab_sweep.h"

namespace edgewise {

class CellVisibility {
  public:
    /// Appends the visible pieces and row owners of `cell` to `out`. `candidates` holds every triangle that
    /// meets it.
    void run(const ScreenScene& scene, const Cell& cell, std::span<const std::uint32_t> candidates,
             const VisibilityOptions& options, CellOutput& out);

    /// The same for a part of a cell whose arithmetic has the whole cell's `origin`: what run() makes of it.
    void runPart(const ScreenScene& scene, const Cell& part, glm::dvec2 origin,
                 std::span<const std::uint32_t> candidates, const VisibilityOptions& options,
                 CellOutput& out);

  private:
    void visit(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin, std::size_t begin,
               std::size_t end, const VisibilityOptions& options, CellOutput& out);

    std::size_t collect(const ScreenScene& scene, const Cell& cell, std::size_t begin, std::size_t end,
                        const VisibilityOptions& options, CellOutput& out);
    bool certify(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin, std::size_t own,
                 const VisibilityOptions& options, CellOutput& out);
    std::size_t dropHidden(const ScreenScene& scene, const Cell& cell, std::size_t from,
                           std::uint32_t occluder);

    std::vector<std::uint32_t> stack_;  ///< candidate lists of the open cells, one behind the other
    SharedEdges shared_edges_;
    SheetOcclusion sheet_occlusion_;
    SheetCertificate certificate_;
    SlabSweep sweep_;
    EdgeVisibility by_edges_;
};

/// Whether the triangle may meet the cell (never false for one that does), and whether it surely covers it.
struct Overlap {
    bool meets, covers;
};
Overlap overlap(const ScreenTriangle& t, const Cell& cell);

}  // namespace edgewise
