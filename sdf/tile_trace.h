// The rays of a tile of pixels through the field: cones first, ever narrower ones, then the rays; eight at a
// time of those that are in one cell, on its tape.
#pragma once

#include <span>
#include <vector>

#include "sdf/cell_tapes.h"
#include "sdf/cone_trace.h"
#include "sdf/ray_grid.h"
#include "sdf/sphere_trace.h"

namespace edgewise::sdf {

/// Sides of tiles, powers of 2. Tiles lie on the grid of multiples of their sides, in absolute pixels, so
/// that a part of a picture has the whole's bits.
struct TileSides {
    int top_px = 64, leaf_px = 8;
    int cone_px = 2;  ///< of the narrowest cones
    /// As many samples a tile, or a tile of one pixel.
    static TileSides forSamples(int per_side);
};

struct TileRay {
    FieldRay ray;
    glm::dvec2 p_px{0.0};     ///< within its tile
    std::uint32_t index = 0;  ///< into the hits
};

struct TileCounts {
    std::uint64_t rays = 0, evaluations = 0, iterations = 0, failed = 0;
    std::uint64_t cones = 0, cone_evaluations = 0;
    std::uint64_t instructions = 0;  ///< for evaluations, as if a point at a time
    std::uint64_t passes = 0;        ///< over tapes: of up to eight points
    std::uint64_t leaf_tiles = 0, empty_tiles = 0;
    PruneCounts prune;
    TileCounts& operator+=(const TileCounts& other);
};

class TileTracer {
  public:
    /// Refers to its arguments. `sign`: -1 where rays start within the solid. `cells`: of the tape; else it
    /// has its own around the eye.
    TileTracer(const Tape& tape, const RayGrid& grid, const TraceSettings& settings, double sign,
               TileSides sides = {}, const CellTapes* cells = nullptr);

    /// Traces rays through the top tile whose corner is at (x, y): multiples of its side. Sorts
    /// the rays.
    void trace(int x_px, int y_px, std::vector<TileRay>& rays, std::span<TraceHit> hits,
               TileCounts& counts) const;
    /// The same of the cones around the rays.
    void traceCones(int x_px, int y_px, std::vector<TileRay>& rays, const ConeSettings& cones,
                    std::span<ConeHits> hits, TileCounts& counts) const;
    /// Rays that need no tile, from their own beginnings; neighbours should be near each other.
    void traceLoose(std::span<const FieldRay> rays, std::span<TraceHit> hits, TileCounts& counts) const;

  private:
    template <class Program>
    friend class TileWork;
    const Tape& tape_;
    const RayGrid& grid_;
    const TraceSettings& settings_;
    double sign_;
    TileSides sides_;
    const CellTapes own_cells_;
    const CellTapes& cells_;
};

}  // namespace edgewise::sdf
