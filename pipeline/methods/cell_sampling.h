// Asks what samples of doubtful pixels see, and divides the pixels among it.
#pragma once

#include "pipeline/methods/cell_division.h"
#include "pipeline/methods/cone_rows.h"

namespace edgewise {

/// The ray of that sign through a place of the film, from t_start on.
sdf::TravellingRay rayFrom(const sdf::RayGrid& grid, const glm::dvec2& p_px, double sign, double t_start);
/// Through a place of the cell, from where its cone found something.
inline sdf::TravellingRay rayFrom(const sdf::RayGrid& grid, const EdgeCell& cell, const glm::dvec2& p_px) {
    return rayFrom(grid, p_px, cell.sign, cell.t_start);
}

class CellSampling {
  public:
    /// Refers to its arguments. `field`: see CellDivision.
    CellSampling(const sdf::RayGrid& grid, FieldTracer& device, const sdf::SceneTracer* field)
        : grid_(grid), device_(device), dividing_(grid, field) {}

    /// By what the centre and the corners see; where that is not enough, by the standard locations too.
    void divide(const ConeRows& rows, std::vector<EdgeCell>& cells);
    std::uint64_t rays() const { return rays_; }

  private:
    void askCorners(const ConeRows& rows, std::vector<EdgeCell>& cells);
    void askStandard(std::vector<EdgeCell*> cells);
    void name(std::vector<EdgeCell*> cells);
    std::vector<EdgeCell*> nameOne(const std::vector<EdgeCell*>& asked);
    void adopt(EdgeCell& cell, CellPiece& piece) const;
    sdf::TravellingRay rayOf(const EdgeCell& cell, int sample) const {
        return rayFrom(grid_, cell, cell.sampleAt(sample));
    }

    const sdf::RayGrid& grid_;
    FieldTracer& device_;
    const CellDivision dividing_;
    std::uint64_t rays_ = 0;
};

}  // namespace edgewise
