// Pixels and pieces of one surface whose neighbours on it see other lights or reflections.
#pragma once

#include "pipeline/methods/cell_shading.h"

namespace edgewise {

class CellLights {
  public:
    /// Refers to its arguments.
    CellLights(const sdf::RayGrid& grid, const sdf::FieldScene& scene, FieldTracer& device,
               const ConeRows& rows, const std::vector<EdgeCell>& cells);

    /// Pieces of divided pixels: shaded at several places. How many.
    std::size_t averagePieces(CellShades& shades) const;
    /// Undivided pixels: divided by the lights' borders (light_borders). Which.
    std::vector<std::size_t> divideOthers(const CellShades& shades, std::vector<glm::dvec4>& colors) const;

  private:
    bool seesOther(const CellShades& shades, std::size_t pixel, std::uint32_t shade,
                   const SurfacePlane& plane) const;
    std::optional<glm::dvec4> otherColor(const CellShades& shades, std::size_t pixel) const;
    bool divided(std::size_t pixel) const {
        return cell_of_[pixel] && cell_of_[pixel]->pieces.front().weight < 1.0;
    }
    std::vector<glm::dvec2> placesOf(const EdgeCell& cell, int piece) const;

    const sdf::RayGrid& grid_;
    const sdf::FieldScene& scene_;
    FieldTracer& device_;
    const ConeRows& rows_;
    const std::vector<EdgeCell>& cells_;
    std::vector<const EdgeCell*> cell_of_;  ///< a pixel's
};

}  // namespace edgewise
