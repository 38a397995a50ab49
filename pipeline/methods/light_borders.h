// Pixels of one surface that the border of a light or of something mirrored crosses.
#pragma once

#include "pipeline/field_tracer.h"
#include "sdf/ray_grid.h"

namespace edgewise {

struct LightCell {
    glm::dvec2 centre_px;
    double sign;              ///< of its rays
    sdf::SurfaceHit hit;      ///< the centre's: its tangent plane stands for the surface
    glm::dvec4 color;         ///< the centre's
    std::uint32_t sight = 0;  ///< the centre's, as FieldTracer::shade() gives it
};

/// The mean colour over each cell: by the line between the two places where the border crosses the cell's
/// sides, if it crosses two; else over 16 places.
std::vector<glm::dvec4> meansOver(const sdf::RayGrid& grid, FieldTracer& tracer,
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
