#include "pipeline/methods/cell_sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace edgewise {
namespace {

std::vector<EdgeCell*> unresolved(std::vector<EdgeCell>& cells) {
    std::vector<EdgeCell*> out;
    for (EdgeCell& cell : cells)
        if (!cell.resolved) out.push_back(&cell);
    return out;
}

/// The corners of pixels: a lattice.
class Corners {
  public:
    explicit Corners(const ConeRows& rows)
        : width_(rows.width()),
          places_((width_ + 1) * (static_cast<std::size_t>(rows.pixels.height()) + 1), kNone) {}

    /// Corner k, 1 to 4, of a pixel: its number.
    std::uint32_t& of(const EdgeCell& cell, int k) {
        const std::size_t x = cell.pixel % width_ + (k & 1 ? 1 : 0),
                          y = cell.pixel / width_ + (k & 2 ? 1 : 0);
        return places_[y * (width_ + 1) + x];
    }
    static constexpr std::uint32_t kNone = 0xffffffffu;

  private:
    const std::size_t width_;
    std::vector<std::uint32_t> places_;
};

}  // namespace

sdf::TravellingRay rayFrom(const sdf::RayGrid& grid, const glm::dvec2& p_px, double sign, double t_start) {
    sdf::TravellingRay ray{grid.ray(p_px), sign};
    ray.ray.t_min = std::max(ray.ray.t_min, std::min(t_start, ray.ray.t_max));
    return ray;
}

void CellSampling::divide(const ConeRows& rows, std::vector<EdgeCell>& cells) {
    const auto divideAll = [&](bool may_count) {
        const std::vector<EdgeCell*> open = unresolved(cells);
        tbb::parallel_for(std::size_t(0), open.size(),
                          [&](std::size_t i) { dividing_.divide(*open[i], may_count); });
    };
    askCorners(rows, cells);
    divideAll(false);
    askStandard(unresolved(cells));
    divideAll(true);
}

/// A corner is asked once for all pixels that it belongs to. Its ray lies in the cones of all four, doubtful
/// or not, and begins where the last of them does.
void CellSampling::askCorners(const ConeRows& rows, std::vector<EdgeCell>& cells) {
    Corners corners(rows);
    std::vector<sdf::TravellingRay> rays;
    for (const EdgeCell& cell : cells)
        for (int k = 1; k <= EdgeCell::kCorners; ++k) {
            std::uint32_t& corner = corners.of(cell, k);
            if (corner != Corners::kNone) continue;
            corner = static_cast<std::uint32_t>(rays.size());
            double start = 0.0;
            const std::size_t left = cell.pixel - (k & 1 ? 0 : 1), above = left - (k & 2 ? 0 : rows.width());
            for (const std::size_t i : {above, above + 1, above + rows.width(), above + rows.width() + 1})
                start = std::max(start, rows.startOf(i, grid_.t_max));
            rays.push_back(rayFrom(grid_, cell.sampleAt(k), cell.sign, start));
        }
    const std::vector<double> depths = device_.batches().depths(rays);
    rays_ += rays.size();
    for (EdgeCell& cell : cells) {
        for (int k = 1; k <= EdgeCell::kCorners; ++k) cell.depths[k] = depths[corners.of(cell, k)];
        cell.samples = 1 + EdgeCell::kCorners;
    }
    name(unresolved(cells));
}

void CellSampling::askStandard(std::vector<EdgeCell*> cells) {
    constexpr int kFirst = 1 + EdgeCell::kCorners;
    std::vector<sdf::TravellingRay> rays(cells.size() * EdgeCell::kStandard);
    tbb::parallel_for(std::size_t(0), rays.size(), [&](std::size_t i) {
        rays[i] = rayOf(*cells[i / EdgeCell::kStandard], kFirst + static_cast<int>(i % EdgeCell::kStandard));
    });
    const std::vector<double> depths = device_.batches().depths(rays);
    rays_ += rays.size();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        std::copy_n(depths.begin() + static_cast<std::ptrdiff_t>(i * EdgeCell::kStandard),
                    EdgeCell::kStandard, cells[i]->depths + kFirst);
        cells[i]->samples = EdgeCell::kMost;
    }
    name(std::move(cells));
}

/// Says of all samples which piece they see, and adds pieces for what is on none.
void CellSampling::name(std::vector<EdgeCell*> cells) {
    while (!cells.empty()) cells = nameOne(cells);
}

/// One more piece for each cell that needs one; the cells that may need another.
std::vector<EdgeCell*> CellSampling::nameOne(const std::vector<EdgeCell*>& asked) {
    std::vector<int> stranger(asked.size(), EdgeCell::kUnknown);
    tbb::parallel_for(std::size_t(0), asked.size(), [&](std::size_t i) {
        EdgeCell& cell = *asked[i];
        for (int k = 1; k < cell.samples; ++k) {
            cell.labels[k] = dividing_.labelOf(cell, k, cell.depths[k]);
            if (cell.labels[k] == EdgeCell::kUnknown) stranger[i] = k;
        }
    });
    std::vector<EdgeCell*> again;
    std::vector<sdf::TravellingRay> rays;
    std::vector<double> depths;
    std::vector<int> samples;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const int k = stranger[i];
        if (k == EdgeCell::kUnknown) continue;
        again.push_back(asked[i]), samples.push_back(k);
        rays.push_back(rayOf(*asked[i], k));
        depths.push_back(asked[i]->depths[k]);
    }
    const std::vector<sdf::SurfaceHit> hits = device_.batches().describe(rays, depths);
    for (std::size_t i = 0; i < again.size(); ++i) {
        EdgeCell& cell = *again[i];
        CellPiece piece = pieceOf(planeOf(hits[i].hit ? &hits[i] : nullptr), cell.sampleAt(samples[i]));
        if (hits[i].hit) piece.hit = hits[i];
        cell.depths[samples[i]] = hits[i].hit ? hits[i].t : HUGE_VAL;
        adopt(cell, piece);
    }
    return again;
}

/// A piece more; surfaces that it goes on from smoothly bend as it says.
void CellSampling::adopt(EdgeCell& cell, CellPiece& piece) const {
    const double radius = piece.hit ? grid_.halfPixel() * (grid_.perspective ? piece.hit->t : 1.0) : 0.0;
    for (CellPiece& known : cell.pieces)
        if (!known.sky && smoothlyOne(known, piece, radius)) {
            const double bend = bendBetween(known, piece);
            known.bend = std::max(known.bend, bend), piece.bend = std::max(piece.bend, bend);
        }
    cell.pieces.push_back(piece);
}

}  // namespace edgewise
