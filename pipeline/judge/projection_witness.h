// Judges the way from the world to the grid: where 50 digits place the vertices of the clipped triangles.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "pipeline/film.h"
#include "pipeline/project.h"

namespace edgewise::judge {

/// How far the pieces of a scene are from where exact arithmetic has them.
struct ProjectionErrors {
    std::size_t vertices = 0;   ///< judged, of pieces
    std::size_t made = 0;       ///< of the exact polygons: where planes cut edges
    std::size_t undecided = 0;  ///< vertices, or triangles, that rounding may place anywhere or drop
    double max_px = 0.0;        ///< distance of a vertex from the exact one that it stands for
    double bound_px = 0.0;      ///< promised for that vertex
    double worst_of_bound = 0.0;
    std::size_t shared_edges = 0;  ///< clipped edges of two triangles that are both seen
    std::size_t cracks = 0;        ///< ... on which the two do not have the same ends, bit for bit
    std::size_t lost_areas = 0;    ///< triangles whose area is off by more than their vertices explain

    void add(const ProjectionErrors& other);
};

/// The promise for a vertex: half a diagonal step of the grid; three roundings of a coordinate in eye space,
/// relative to the sum of its products' sizes, or one where a plane made it and what double-double loses
/// on the way there, and what that comes to on the screen; four roundings of the quotient. Takes perspective
/// cameras without a far plane.
ProjectionErrors judgeProjection(const std::vector<std::array<glm::vec3, 3>>& world,
                                 const ResolvedCamera& camera, const Film& film, const ScreenScene& screen,
                                 const ScreenPieces& pieces);

}  // namespace edgewise::judge
