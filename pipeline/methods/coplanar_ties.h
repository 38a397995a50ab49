// Equal depth goes to the lower index: which of the coplanar triangles over a sample is seen.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <unordered_map>
#include <vector>

#include "analytic/screen_triangle.h"

namespace edgewise {

/// Of the opaque triangles of one projected scene: who has found one of several that share a depth plane
/// learns which one exact samples see. Triangles by their place in ScreenScene::triangles.
class CoplanarTies {
  public:
    /// Refers to the scene.
    explicit CoplanarTies(const ScreenScene& screen);

    /// `found`, or what hides it at a point of the grid: the lowest of its plane that covers the point (a
    /// point on an edge belongs to the triangle whose top or left edge it is). Most triangles nothing can
    /// hide.
    std::uint32_t seenAt(std::uint32_t found, glm::dvec2 p_px) const {
        return hidden_.empty() || hidden_[found] == 0 ? found : lowestAt(found, p_px);
    }

    /// Whether any triangle hides another of its plane.
    bool any() const { return !hidden_.empty(); }

  private:
    using Ids = std::vector<std::uint32_t>;

    /// A plane's triangles by the cells of a lattice over them.
    struct Sheet {
        glm::dvec2 low_px{0.0}, cells_per_px{0.0};
        int side = 1;                    ///< cells
        std::vector<std::size_t> begin;  ///< by cell, into `ids`
        Ids ids;                         ///< ascending in each cell

        int cellAt(double from_low_px, double per_px) const;
        /// Calls visit(cell) for every cell that the triangle's box meets.
        template <class Visit>
        void forCells(const ScreenTriangle& triangle, const Visit& visit) const;
    };

    Sheet sheetOf(const Ids& ids) const;
    void fillCells(const Ids& ids, Sheet& sheet) const;
    bool isHidden(std::uint32_t id, const Sheet& sheet) const;
    std::uint32_t lowestAt(std::uint32_t found, glm::dvec2 p_px) const;

    const ScreenScene& screen_;
    std::vector<std::uint8_t> hidden_;  ///< by triangle: one of a lower index overlaps it; empty: of none
    std::unordered_map<std::uint32_t, Sheet> sheets_;  ///< by plane, where triangles are hidden
};

}  // namespace edgewise
