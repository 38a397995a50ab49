// What a sheet of triangles hides in a cell. Triangles that hang together by shared edges are one sheet; if
// each of its edges that meets the cell has a triangle on either side, the number of its triangles over a
// point changes nowhere in the cell: one point that lies in one of them shows that the sheet covers the cell.
// What lies behind the farthest of a covering sheet is not seen.
#pragma once

#include <span>
#include <vector>

#include "analytic/shared_edges.h"

namespace edgewise {

class SheetOcclusion {
  public:
    /// By place in the list, 1 where a sheet surely hides the triangle on the whole cell. `shared` are the
    /// list's edges; all of its triangles are opaque. Empty where no sheet covers the cell.
    std::span<const std::uint8_t> hidden(const ScreenScene& scene, const Cell& cell,
                                         std::span<const std::uint32_t> triangles, const SharedEdges& shared);

  private:
    std::uint32_t sheetOf(std::uint32_t place);
    void findSheets(const SharedEdges& shared, std::size_t count);
    void findCovering(const ScreenScene& scene, const Cell& cell, std::span<const std::uint32_t> triangles);

    std::vector<std::uint32_t> parent_;
    std::vector<std::uint8_t> open_, covers_, hidden_;  ///< by place; the first two by a sheet's root
    std::vector<double> farthest_, nearest_;            ///< by place: bounds of the depth over the cell
};

}  // namespace edgewise
