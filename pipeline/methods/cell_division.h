// Divides pixels among the surfaces that their samples see, by straight lines.
#pragma once

#include "pipeline/methods/edge_cell.h"
#include "sdf/film_line.h"
#include "sdf/scene_trace.h"

namespace edgewise {

class CellDivision {
  public:
    /// Refers to its arguments. `tracer`: of the scene, for distances between rays and solids; without it
    /// there are no outlines.
    CellDivision(const sdf::RayGrid& grid, const sdf::SceneTracer* tracer) : grid_(grid), tracer_(tracer) {}

    /// The piece that sample i of that depth sees; kUnknown where it is on none.
    int labelOf(const EdgeCell& cell, int i, double depth) const;
    /// Gives the cell its parts: halves it by creases and outlines until every part's samples see one piece.
    /// Where no line agrees with the samples, they are counted, if `may_count`; else the cell stays
    /// unresolved.
    void divide(EdgeCell& cell, bool may_count) const;

  private:
    class Work;
    sdf::FieldRay rayOf(const glm::dvec2& p_px) const { return grid_.ray(p_px); }
    bool divideByStrip(EdgeCell& cell) const;
    std::optional<sdf::FilmLine> outlineFrom(const glm::dvec2& p_px, double t) const;

    const sdf::RayGrid& grid_;
    const sdf::SceneTracer* tracer_;
};

}  // namespace edgewise
