// Pixels of one surface that the border of a light or of something mirrored crosses.
#pragma once

#include <optional>

#include "pipeline/methods/cone_rows.h"

namespace edgewise {

struct LightCell {
    std::size_t pixel = 0;
    sdf::SurfaceHit hit;      ///< the centre's: its tangent plane stands for the surface
    glm::dvec4 color{0.0};    ///< the centre's
    std::uint32_t sight = 0;  ///< the centre's, as FieldTracer::shade() gives it
    /// Beyond the border, if a neighbour tells: else it is asked for.
    std::optional<glm::dvec4> other_color;
};

/// The mean colour over each cell: by the line between the two places where the border crosses the cell's
/// sides, if it crosses two; else over 16 places. Neighbours on one surface ask for corners and crossings
/// once.
std::vector<glm::dvec4> meansOver(const sdf::RayGrid& grid, FieldTracer& tracer, const ConeRows& rows,
                                  const std::vector<LightCell>& cells);

/// A surface at places of the film.
struct LitPiece {
    double sign;          ///< of its rays
    sdf::SurfaceHit hit;  ///< its tangent plane stands for the surface
    std::vector<glm::dvec2> places_px;
};

/// The mean colour of each over its places.
std::vector<glm::dvec4> meansAt(const sdf::RayGrid& grid, FieldTracer& tracer,
                                std::span<const LitPiece> pieces);

}  // namespace edgewise
